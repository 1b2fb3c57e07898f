// The files of the page, bundled when the server is built.
#pragma once

#include <span>
#include <string_view>

namespace spherematch {

struct PageFile {
  std::string_view name;  ///< "index.html", or what stands behind /page/
  std::string_view content_type;
  std::string_view bytes;
  std::string_view gzip;  ///< the same, compressed
};

/// index.html comes first; empty in a server that was built without the page.
[[nodiscard]] std::span<const PageFile> page_files();

}  // namespace spherematch
