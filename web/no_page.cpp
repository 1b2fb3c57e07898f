#include "web/page_files.h"

namespace spherematch {

std::span<const PageFile> page_files() { return {}; }

}  // namespace spherematch
