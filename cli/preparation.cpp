#include "cli/preparation.h"

#include <unistd.h>

#include <iostream>
#include <vector>

#include "cli/files.h"
#include "cli/progress_bar.h"
#include "engine/engine.h"
#include "engine/io/mesh_reader.h"
#include "storage/content_id.h"
#include "storage/upload_options.h"

namespace spherematch {

namespace {

/// What the store has, if it is of this engine and readable.
std::shared_ptr<const PreprocessedShape> stored_shape(const ShapeStore& store, const ShapeRecord& record) {
  if (record.state != ShapeState::ready || record.engine != engine_version()) return nullptr;
  try {
    return store.load_prepared(record.id);
  } catch (const StorageError& error) {
    // Damaged, of another codec, or removed by a server a moment ago: all can be made again from the file.
    if (error.code() == StorageErrorCode::busy || error.code() == StorageErrorCode::io) throw;
    std::cerr << "prepared again: " << error.what() << "\n";
    return nullptr;
  }
}

PreprocessedShape compute(Surface surface, int threads) {
  ProgressBar bar(std::cerr, ::isatty(STDERR_FILENO) != 0);
  const Progress progress{.report = [&bar](std::string_view stage, double fraction) { bar.report(stage, fraction); }, .stop = {}};
  return preprocess(std::move(surface), {}, progress, threads);
}

}  // namespace

Preparation prepare_file(ShapeStore& store, const std::filesystem::path& file, const PreparationOptions& options) {
  const std::vector<std::byte> bytes = read_file(file);
  const ContentId content = content_id(bytes, upload_options(options.read));
  const auto record = store.find(content.id);
  if (record) {
    if (auto shape = stored_shape(store, *record)) return {content.id, std::move(shape), true};
  }
  const std::string name = file.filename().string();
  if (!record) {
    const Surface surface = read_surface(bytes, name, options.read);
    store.insert(content, {.name = name, .format = std::string(mesh_format_of(bytes, name)), .tags = {}}, bytes, surface);
  }
  // A server on the same store may prepare it at the same time. Both get the same result, and saving it twice does no harm.
  auto shape = std::make_shared<const PreprocessedShape>(compute(store.load_surface(content.id), options.threads));
  store.save_prepared(content.id, *shape);
  return {content.id, std::move(shape), false};
}

}  // namespace spherematch
