#include "bench/experiments/prepared_shapes.h"

#include "cli/preparation.h"

namespace spherematch::bench {

const MatchShape& PreparedShapes::operator()(const std::filesystem::path& file) {
  auto& shape = shapes_[file];
  if (!shape) shape = std::make_unique<const MatchShape>(prepare_file(store_, file, {.read = {}, .threads = threads_}).shape);
  return *shape;
}

}  // namespace spherematch::bench
