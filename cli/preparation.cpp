#include "cli/preparation.h"

#include <unistd.h>

#include <cerrno>
#include <fstream>
#include <iostream>
#include <system_error>
#include <vector>

#include "cli/exit_code.h"
#include "cli/progress_bar.h"
#include "engine/engine.h"
#include "storage/content_id.h"
#include "storage/upload_options.h"

namespace spherematch {

namespace {

std::vector<std::byte> read_file(const std::filesystem::path& file) {
  // Opening a directory succeeds and reading it fails late, with a message that helps nobody.
  if (std::filesystem::is_directory(file)) throw FileError(file.string() + ": is a directory");
  std::ifstream in(file, std::ios::binary | std::ios::ate);
  if (!in) throw FileError(file.string() + ": " + std::generic_category().message(errno));
  std::vector<std::byte> bytes(static_cast<std::size_t>(in.tellg()));
  in.seekg(0);
  in.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  if (!in) throw FileError(file.string() + ": cannot be read");
  return bytes;
}

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
  const ContentId content = content_id(bytes, upload_options(options.repair));
  const auto record = store.find(content.id);
  if (record) {
    if (auto shape = stored_shape(store, *record)) return {content.id, std::move(shape), true};
  }
  const std::string name = file.filename().string();
  if (!record) store.insert(content, name, bytes, read_surface(bytes, name, options.repair));
  // A server on the same store may prepare it at the same time. Both get the same result, and saving it twice does no harm.
  auto shape = std::make_shared<const PreprocessedShape>(compute(store.load_surface(content.id), options.threads));
  store.save_prepared(content.id, *shape);
  return {content.id, std::move(shape), false};
}

}  // namespace spherematch
