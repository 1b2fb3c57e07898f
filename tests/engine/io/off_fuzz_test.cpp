// Damaged OFF files end in a mesh or in an EngineError, never in anything else. The sanitizer build gives this its teeth.
#include <gtest/gtest.h>

#include <random>
#include <string>

#include "engine/data/error.h"
#include "engine/io/mesh_reader.h"
#include "engine/io/off.h"
#include "engine/mesh/repair.h"
#include "tests/support/meshes.h"
#include "tests/support/surface_checks.h"

namespace spherematch {
namespace {

/// Reads, and when that works repairs; true when a surface came of it, which then must keep its promises.
bool survives(const std::string& text) {
  try {
    const PolygonMesh mesh = read_mesh(std::as_bytes(std::span(text)), "damaged.off");
    const Surface surface = repair(mesh, RepairMode::fill);
    test::expect_invariants(surface, mesh);
    return true;
  } catch (const EngineError&) {
    return false;
  }
}

TEST(OffFuzz, EveryTruncation) {
  const std::string text = write_off(test::icosphere(1));
  int survived = 0;
  for (std::size_t length = 0; length <= text.size(); ++length) survived += survives(text.substr(0, length)) ? 1 : 0;
  // Only the loss of the last line's end, or of digits of its last index, leaves a whole mesh.
  EXPECT_GE(survived, 2);
  EXPECT_LE(survived, 4);
}

TEST(OffFuzz, RandomBytes) {
  const std::string text = write_off(test::icosphere(1));
  std::mt19937_64 random(20240501);
  int survived = 0;
  constexpr int rounds = 3000;
  for (int round = 0; round < rounds; ++round) {
    std::string damaged = text;
    const std::size_t flips = 1 + random() % 4;
    for (std::size_t i = 0; i < flips; ++i) damaged[random() % damaged.size()] = static_cast<char>(random() % 256);
    survived += survives(damaged) ? 1 : 0;
  }
  EXPECT_GT(survived, 0);
  EXPECT_LT(survived, rounds);
}

TEST(OffFuzz, RandomDigits) {
  // Digits for digits keep the file readable, so that the damage reaches repair.
  const std::string text = write_off(test::icosphere(1));
  std::mt19937_64 random(20240502);
  int survived = 0;
  constexpr int rounds = 3000;
  for (int round = 0; round < rounds; ++round) {
    std::string damaged = text;
    const std::size_t flips = 1 + random() % 30;
    for (std::size_t i = 0; i < flips; ++i) {
      char& c = damaged[12 + random() % (damaged.size() - 12)];
      if (c >= '0' && c <= '9') c = static_cast<char>('0' + random() % 10);
    }
    survived += survives(damaged) ? 1 : 0;
  }
  EXPECT_GT(survived, rounds / 10);
}

TEST(OffFuzz, RandomFaces) {
  // Faces at random over few vertices: every kind of non-manifold edge and vertex.
  std::mt19937_64 random(20240503);
  for (int round = 0; round < 3000; ++round) {
    const std::uint64_t vertices = 4 + random() % 8;
    const std::uint64_t faces = 1 + random() % 24;
    std::string text = "OFF\n" + std::to_string(vertices) + ' ' + std::to_string(faces) + " 0\n";
    for (std::uint64_t i = 0; i < 3 * vertices; ++i) text += std::to_string(random() % 4) + (i % 3 == 2 ? '\n' : ' ');
    for (std::uint64_t f = 0; f < faces; ++f) {
      const std::uint64_t corners = 3 + random() % 4;
      text += std::to_string(corners);
      for (std::uint64_t k = 0; k < corners; ++k) text += ' ' + std::to_string(random() % vertices);
      text += '\n';
    }
    (void)survives(text);
    if (HasFailure()) FAIL() << text;
  }
}

}  // namespace
}  // namespace spherematch
