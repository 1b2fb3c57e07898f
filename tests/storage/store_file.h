// A store's file in a directory of its own, gone at the end of the test, and what the tests put into it.
#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <string>
#include <system_error>
#include <vector>

#include "storage/content_id.h"
#include "storage/shape_store.h"
#include "tests/storage/sample_shapes.h"

namespace spherematch::testing {

class StoreFile {
 public:
  StoreFile() {
    std::string pattern = (std::filesystem::temp_directory_path() / "spherematch-store-XXXXXX").string();
    if (mkdtemp(pattern.data()) == nullptr) throw std::system_error(errno, std::generic_category(), "mkdtemp");
    directory_ = pattern;
  }
  ~StoreFile() {
    std::error_code ignored;
    std::filesystem::remove_all(directory_, ignored);
  }
  StoreFile(const StoreFile&) = delete;
  StoreFile& operator=(const StoreFile&) = delete;

  [[nodiscard]] std::filesystem::path path() const { return directory_ / "store.db"; }
  [[nodiscard]] const std::filesystem::path& directory() const { return directory_; }

 private:
  std::filesystem::path directory_;
};

/// Upload number i: its bytes and its surface.
struct SampleUpload {
  explicit SampleUpload(unsigned number)
      : text("OFF upload " + std::to_string(number)), content(content_id(bytes(), "repair=fill")), surface(sample_surface(12, number)) {}

  [[nodiscard]] std::span<const std::byte> bytes() const { return std::as_bytes(std::span(text)); }

  std::string text;
  ContentId content;
  Surface surface;
};

inline InsertOutcome insert(ShapeStore& store, const SampleUpload& upload, const ShapeLabels& labels) {
  return store.insert(upload.content, labels, upload.bytes(), upload.surface);
}

inline InsertOutcome insert(ShapeStore& store, const SampleUpload& upload, const std::string& name = "") {
  return insert(store, upload, ShapeLabels{.name = name, .format = "off", .tags = {}});
}

inline void expect_holds(const ShapeStore& store, const SampleUpload& upload) {
  const std::vector<std::byte> loaded = store.load_upload(upload.content.id);
  EXPECT_EQ(std::string(reinterpret_cast<const char*>(loaded.data()), loaded.size()), upload.text);
  expect_same(store.load_surface(upload.content.id), upload.surface);
}

}  // namespace spherematch::testing
