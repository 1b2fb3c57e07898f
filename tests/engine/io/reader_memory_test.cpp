// Reading takes memory in proportion to the file, whatever the file says of itself. A program of its own, for it counts every
// allocation of the process.
#include <gtest/gtest.h>
#include <malloc.h>

#include <atomic>
#include <memory>
#include <string>

#include "engine/data/error.h"
#include "engine/io/gltf_json.h"
#include "tests/engine/io/reading.h"
#include "tests/support/mesh_files.h"
#include "tests/support/meshes.h"

namespace {

std::atomic<std::int64_t> used = 0;
std::atomic<std::int64_t> peak = 0;

void* counted(void* memory) {
  const std::int64_t now = used += static_cast<std::int64_t>(malloc_usable_size(memory));
  if (now > peak) peak = now;
  return memory;
}

void uncount(void* memory) { used -= static_cast<std::int64_t>(malloc_usable_size(memory)); }

}  // namespace

#if !defined(__SANITIZE_ADDRESS__)
// glibc calls these in place of its own, also from libraries; operator new comes here too.
extern "C" {
void* __libc_malloc(std::size_t);
void* __libc_calloc(std::size_t, std::size_t);
void* __libc_realloc(void*, std::size_t);
void* __libc_memalign(std::size_t, std::size_t);
void __libc_free(void*);

void* malloc(std::size_t size) noexcept { return counted(__libc_malloc(size)); }
void* calloc(std::size_t count, std::size_t size) noexcept { return counted(__libc_calloc(count, size)); }
void* realloc(void* memory, std::size_t size) noexcept {
  uncount(memory);
  return counted(__libc_realloc(memory, size));
}
void* aligned_alloc(std::size_t alignment, std::size_t size) noexcept { return counted(__libc_memalign(alignment, size)); }
void free(void* memory) noexcept {
  uncount(memory);
  __libc_free(memory);
}
}
#endif

namespace spherematch {
namespace {

constexpr std::int64_t mebibyte = 1 << 20;

/// How much more is allocated at most while reading than before.
std::int64_t growth(const std::string& bytes, const std::string& name, bool* refused = nullptr) {
  const std::int64_t before = used;
  peak = before;
  bool threw = false;
  try {
    (void)test::read(bytes, name);
  } catch (const EngineError&) {
    threw = true;
  }
  if (refused != nullptr) *refused = threw;
  return peak - before;
}

class ReaderMemory : public testing::Test {
 protected:
  void SetUp() override {
#if defined(__SANITIZE_ADDRESS__)
    GTEST_SKIP() << "the sanitizer has its own allocations";
#endif
    const std::int64_t before = used;
    peak = before;
    const auto block = std::make_unique<Points>(100'000, 3);
    ASSERT_GE(peak - before, 2'400'000) << "allocations are not counted";
    ASSERT_EQ(block->rows(), 100'000);
  }
};

TEST_F(ReaderMemory, IsASmallMultipleOfTheFile) {
  const PolygonMesh mesh = test::fit_for_every_format(test::icosphere(6));
  for (const auto& [name, bytes] : test::in_every_format(mesh)) {
    const auto size = static_cast<std::int64_t>(bytes.size());
    const std::int64_t taken = growth(bytes, name);
    EXPECT_LT(taken, 7 * size) << name << " of " << size;
  }
}

TEST_F(ReaderMemory, DoesNotFollowWhatTheFileAnnounces) {
  const PolygonMesh small = test::polygons(test::tetrahedron());
  const std::string binary_ply = test::ply_file(small, test::PlyKind::little_endian);
  std::string stl = test::binary_stl_file(small);
  stl.replace(80, 4, "\xFF\xFF\xFF\x7F");
  for (const auto& [name, bytes] : std::vector<test::MeshFile>{
           {"a.off", test::with(test::off_file(small), "4 4 0", "299999 599999 0")},
           {"a.ply", test::with(binary_ply, "vertex 4", "vertex 299999")},
           {"b.ply", test::with(binary_ply, "face 4", "face 299999999")},
           {"a.stl", stl},
           {"a.glb",
            test::glb_container(test::with(test::gltf_json(4, 12, ""), R"("count": 4)", R"("count": 299999)"), test::gltf_buffer(small))},
           {"b.glb",
            test::glb_container(test::with(test::gltf_json(4, 12, ""), R"("count": 12)", R"("count": 2999997)"), test::gltf_buffer(small))},
           {"c.glb", test::glb_container(test::with(test::gltf_json(4, 12, ""), R"("byteLength": 96)", R"("byteLength": 2147483647)"),
                                         test::gltf_buffer(small))}}) {
    bool refused = false;
    EXPECT_LT(growth(bytes, name, &refused), mebibyte) << name;
    EXPECT_TRUE(refused) << name;
  }
}

/// As many items as gltf_json.cpp lets pass must not take more than it counts for them: 64 MiB and four times the file.
TEST_F(ReaderMemory, OfJsonStaysWithinItsBudget) {
  const auto repeated = [](const std::string& before, const std::string& item, const std::string& after, std::size_t count) {
    std::string text = R"({"asset": {"version": "2.0"}, )" + before;
    for (std::size_t i = 0; i < count; ++i) text += (i > 0 ? "," : "") + item;
    return text + after + "}";
  };
  struct Case {
    const char* before;
    const char* item;
    const char* after;
  };
  for (const auto& [before, item, after] : std::vector<Case>{
           {R"("nodes": [)", "{}", "]"},
           {R"("nodes": [)", R"({"children": []})", "]"},
           {R"("nodes": [{"children": [)", "0", "]}]"},
           {R"("nodes": [{"matrix": [)", "1", "]}]"},
           {R"("meshes": [)", "{}", "]"},
           {R"("meshes": [{"primitives": [)", R"({"attributes": {}})", "]}]"},
           {R"("meshes": [{"primitives": [)", R"({"attributes": {"POSITION": 0, "mode": 0, "mesh": 0, "type": 0, "count": 0, "uri": 0}})",
            "]}]"},
           {R"("bufferViews": [)", R"({"buffer": 0, "byteLength": 1})", "]"},
           {R"("accessors": [)", R"({"componentType": 5126, "count": 1, "type": "VEC3"})", "]"},
           {R"("extensionsUsed": [)", R"("")", "]"},
           {R"("materials": [)", "{}", "]"},
       }) {
    // The most that pass, by bisection.
    std::size_t passing = 1;
    for (std::size_t step = 1 << 19; step > 0; step /= 2) {
      std::string text = repeated(before, item, after, passing + step);
      try {
        reduce_gltf_json(std::span(text), 0, text.size());
        passing += step;
      } catch (const EngineError& error) {
        ASSERT_NE(std::string_view(error.what()).find("too many values"), std::string_view::npos) << error.what();
      }
    }
    const std::string text = repeated(before, item, after, passing);
    const auto size = static_cast<std::int64_t>(text.size());
    EXPECT_LT(growth(text, "a.gltf"), 64 * mebibyte + 4 * size + 2 * size + 2 * mebibyte) << passing << " of " << item;
  }
}

}  // namespace
}  // namespace spherematch
