// Short forms for the tests of the mesh readers.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <string_view>
#include <vector>

#include "engine/data/error.h"
#include "engine/io/mesh_reader.h"

namespace spherematch::test {

inline PolygonMesh read(std::string_view bytes, std::string_view name = "", const ReadLimits& limits = {}) {
  return read_mesh(std::as_bytes(std::span(bytes)), name, limits);
}

/// Fails the test unless reading throws this code with a message that has `fragment` in it.
inline void expect_refused(ErrorCode code, std::string_view fragment, std::string_view bytes, std::string_view name = "",
                           const ReadLimits& limits = {}) {
  const std::string_view start = bytes.substr(0, 400);
  try {
    (void)read(bytes, name, limits);
    ADD_FAILURE() << "not refused, expected '" << fragment << "': " << start;
  } catch (const EngineError& error) {
    EXPECT_EQ(error.code(), code) << error.what() << ": " << start;
    EXPECT_NE(std::string_view(error.what()).find(fragment), std::string_view::npos) << error.what() << ", expected '" << fragment << '\'';
  }
}

inline void expect_same(const PolygonMesh& mesh, const PolygonMesh& expected, std::string_view what = "") {
  ASSERT_EQ(mesh.vertex_count(), expected.vertex_count()) << what;
  EXPECT_EQ(mesh.vertices, expected.vertices) << what;
  EXPECT_EQ(mesh.offsets, expected.offsets) << what;
  EXPECT_EQ(mesh.indices, expected.indices) << what;
}

/// `text` with the first `from` replaced; fails the test when there is none.
inline std::string with(std::string text, std::string_view from, std::string_view to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

}  // namespace spherematch::test
