// From a mesh file to a prepared shape, by way of the store.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "engine/data/preprocessed_shape.h"
#include "engine/data/surface.h"
#include "storage/shape_store.h"

namespace spherematch {

struct PreparationOptions {
  ReadOptions read;
  int threads = 1;
};

struct Preparation {
  std::string id;
  std::shared_ptr<const PreprocessedShape> shape;
  bool was_stored = false;  ///< nothing had to be computed
};

/// Takes the shape from the store, or computes it and stores it, with a progress bar on standard error where that is a terminal.
/// @throws FileError, EngineError, StorageError
[[nodiscard]] Preparation prepare_file(ShapeStore& store, const std::filesystem::path& file, const PreparationOptions& options);

}  // namespace spherematch
