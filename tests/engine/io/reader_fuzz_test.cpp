// Damaged files of every format end in a mesh or in an EngineError, never in anything else. The sanitizer build gives this its teeth.
#include <gtest/gtest.h>

#include <random>
#include <string>

#include "engine/data/error.h"
#include "engine/io/mesh_reader.h"
#include "engine/mesh/repair.h"
#include "tests/support/mesh_files.h"
#include "tests/support/meshes.h"
#include "tests/support/surface_checks.h"

namespace spherematch {
namespace {

using test::MeshFile;

enum class Fate { refused, read, repaired };

/// Fails the test unless the mesh keeps what engine/io/polygon_mesh.h promises.
void expect_promises(const PolygonMesh& mesh) {
  ASSERT_GE(mesh.face_count(), 1);
  ASSERT_TRUE(mesh.vertices.allFinite());
  ASSERT_EQ(mesh.offsets.front(), 0);
  ASSERT_EQ(static_cast<std::size_t>(mesh.offsets.back()), mesh.indices.size());
  for (std::int32_t f = 0; f < mesh.face_count(); ++f)
    ASSERT_GE(mesh.offsets[static_cast<std::size_t>(f) + 1] - mesh.offsets[static_cast<std::size_t>(f)], 3);
  for (const std::int32_t index : mesh.indices) ASSERT_TRUE(index >= 0 && index < mesh.vertex_count());
}

/// Reads, and when that works repairs. Each result must keep its promises.
Fate fate_of(const std::string& bytes, const std::string& name) {
  Fate fate = Fate::refused;
  try {
    const PolygonMesh mesh = read_mesh(std::as_bytes(std::span(bytes)), name);
    fate = Fate::read;
    expect_promises(mesh);
    const Surface surface = repair(mesh, RepairMode::fill);
    fate = Fate::repaired;
    // Where one vertex is very far away, which side is out is lost in rounding.
    constexpr double far_away = 1000;
    if (mesh.vertices.cwiseAbs().maxCoeff() < far_away) test::expect_invariants(surface, mesh);
  } catch (const EngineError&) {
    // as it should be
  }
  return fate;
}

class ReaderFuzz : public testing::TestWithParam<std::size_t> {
 protected:
  [[nodiscard]] static MeshFile file(const TriMesh& mesh) { return test::in_every_format(test::fit_for_every_format(mesh))[GetParam()]; }
};

TEST_P(ReaderFuzz, EveryTruncation) {
  const MeshFile whole = file(test::icosphere(1));
  ASSERT_EQ(fate_of(whole.bytes, whole.name), Fate::repaired);
  const bool is_obj = whole.name == "a.obj";
  for (std::size_t length = 0; length < whole.bytes.size(); ++length) {
    const Fate fate = fate_of(whole.bytes.substr(0, length), whole.name);
    if (HasFailure()) FAIL() << whole.name << " cut to " << length;
    // Text may lose its last line's end, and digits of its last number. OBJ has no counts, so that any number of faces is a file.
    if (!is_obj && length + 4 < whole.bytes.size()) {
      ASSERT_EQ(fate, Fate::refused) << whole.name << " cut to " << length;
    }
  }
}

TEST_P(ReaderFuzz, RandomBytes) {
  const MeshFile whole = file(test::icosphere(1));
  std::mt19937_64 random(20240501 + GetParam());
  int survived = 0;
  constexpr int rounds = 2000;
  for (int round = 0; round < rounds; ++round) {
    std::string damaged = whole.bytes;
    const std::size_t changes = 1 + random() % 4;
    for (std::size_t i = 0; i < changes; ++i) damaged[random() % damaged.size()] = static_cast<char>(random() % 256);
    survived += fate_of(damaged, whole.name) == Fate::refused ? 0 : 1;
    if (HasFailure()) FAIL() << whole.name << " round " << round;
  }
  EXPECT_GT(survived, 0);
  EXPECT_LT(survived, rounds);
}

TEST_P(ReaderFuzz, RandomDigits) {
  // Digits for digits keep text readable, so that the damage reaches counts, references and repair.
  const MeshFile whole = file(test::icosphere(1));
  std::mt19937_64 random(20240502 + GetParam());
  int survived = 0;
  constexpr int rounds = 2000;
  for (int round = 0; round < rounds; ++round) {
    std::string damaged = whole.bytes;
    const std::size_t changes = 1 + random() % 30;
    for (std::size_t i = 0; i < changes; ++i) {
      char& c = damaged[random() % damaged.size()];
      if (c >= '0' && c <= '9') c = static_cast<char>('0' + random() % 10);
    }
    survived += fate_of(damaged, whole.name) == Fate::refused ? 0 : 1;
    if (HasFailure()) FAIL() << whole.name << " round " << round;
  }
  EXPECT_GT(survived, rounds / 50);
}

TEST_P(ReaderFuzz, RandomCuts) {
  // Pieces left out, doubled or put elsewhere.
  const MeshFile whole = file(test::icosphere(1));
  std::mt19937_64 random(20240503 + GetParam());
  for (int round = 0; round < 2000; ++round) {
    const std::size_t from = random() % whole.bytes.size();
    const std::size_t length = 1 + random() % 40;
    std::string damaged = whole.bytes;
    if (round % 3 != 0) damaged.erase(from, length);
    if (round % 3 != 1) damaged.insert(random() % damaged.size(), whole.bytes.substr(from, length));
    (void)fate_of(damaged, whole.name);
    if (HasFailure()) FAIL() << whole.name << " round " << round;
  }
}

INSTANTIATE_TEST_SUITE_P(EveryFormat, ReaderFuzz, testing::Range<std::size_t>(0, 9), [](const testing::TestParamInfo<std::size_t>& format) {
  std::string name = test::in_every_format(test::fit_for_every_format(test::tetrahedron()))[format.param].name;
  name.erase(name.find('.'), 1);
  return name;
});

TEST(ReaderFuzzFormats, AreAllThere) { EXPECT_EQ(test::in_every_format(test::fit_for_every_format(test::tetrahedron())).size(), 9U); }

TEST(ReaderFuzzFaces, AtRandom) {
  // Faces at random over few vertices: every kind of non-manifold edge and vertex.
  std::mt19937_64 random(20240504);
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
    (void)fate_of(text, "");
    if (HasFailure()) FAIL() << text;
  }
}

}  // namespace
}  // namespace spherematch
