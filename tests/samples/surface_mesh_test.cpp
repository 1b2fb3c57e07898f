#include "samples/surface_mesh.h"

#include <gtest/gtest.h>

#include <random>
#include <stdexcept>

#include "tests/samples/meshes.h"

namespace spherematch::samples {
namespace {

/// Made anew from its faces, the mesh must pass the checks of the constructor and still be a sphere.
void expect_sphere(const SurfaceMesh& mesh) {
  const Mesh flat = mesh.compact();
  EXPECT_NO_THROW(SurfaceMesh{flat});
  EXPECT_EQ(static_cast<long>(flat.vertices.size()) - static_cast<long>(flat.triangles.size()) / 2, 2);
}

TEST(SamplesSurfaceMesh, RefusesWhatIsNotClosedOrNotOriented) {
  Mesh open = sphere_mesh(1);
  open.triangles.pop_back();
  EXPECT_THROW(SurfaceMesh{open}, std::invalid_argument);
  Mesh turned = sphere_mesh(1);
  std::swap(turned.triangles[0][0], turned.triangles[0][1]);
  EXPECT_THROW(SurfaceMesh{turned}, std::invalid_argument);
}

TEST(SamplesSurfaceMesh, SplitAddsOneVertexAndTwoFaces) {
  SurfaceMesh mesh(sphere_mesh(1));
  const std::size_t vertices = mesh.compact().vertices.size();
  const int a = mesh.origin(5), b = mesh.target(5);
  const int m = mesh.split(5, {9, 9, 9});
  EXPECT_EQ(mesh.position(m), (Vec3{9, 9, 9}));
  EXPECT_EQ(mesh.valence(m), 4);
  EXPECT_EQ(mesh.origin(5), a);
  EXPECT_EQ(mesh.target(5), m);
  bool reaches_b = false;
  for (const int out : mesh.outgoing(m)) reaches_b = reaches_b || mesh.target(out) == b;
  EXPECT_TRUE(reaches_b);
  EXPECT_EQ(mesh.compact().vertices.size(), vertices + 1);
  expect_sphere(mesh);
}

TEST(SamplesSurfaceMesh, FlipJoinsTheApexes) {
  SurfaceMesh mesh(sphere_mesh(2));
  const int c = mesh.apex(7), d = mesh.apex(mesh.twin(7));
  ASSERT_TRUE(mesh.flip(7));
  EXPECT_EQ(mesh.origin(7), d);
  EXPECT_EQ(mesh.target(7), c);
  expect_sphere(mesh);

  SurfaceMesh tetrahedron(Mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}});
  EXPECT_FALSE(tetrahedron.flip(0)) << "the apexes are joined already";
}

TEST(SamplesSurfaceMesh, CollapseKeepsTheTarget) {
  SurfaceMesh mesh(sphere_mesh(2));
  const int a = mesh.origin(11), b = mesh.target(11);
  const Vec3 place = mesh.position(b);
  ASSERT_TRUE(mesh.can_collapse(11));
  mesh.collapse(11);
  EXPECT_FALSE(mesh.vertex_alive(a));
  EXPECT_FALSE(mesh.halfedge_alive(11));
  EXPECT_EQ(mesh.position(b), place);
  expect_sphere(mesh);
}

TEST(SamplesSurfaceMesh, StaysASphereUnderAnyOperations) {
  SurfaceMesh mesh(sphere_mesh(2));
  std::mt19937_64 random(3);
  int collapsed = 0, refused = 0;
  for (int i = 0; i < 4000; ++i) {
    const int h = static_cast<int>(random() % static_cast<std::uint64_t>(mesh.halfedge_count()));
    if (!mesh.halfedge_alive(h)) continue;
    switch (random() % 4) {
      case 0:
        mesh.split(h, 0.5 * (mesh.position(mesh.origin(h)) + mesh.position(mesh.target(h))));
        break;
      case 1:
        if (mesh.valence(mesh.origin(h)) > 3 && mesh.valence(mesh.target(h)) > 3) mesh.flip(h);
        break;
      default:
        if (mesh.can_collapse(h)) {
          mesh.collapse(h);
          ++collapsed;
        } else {
          ++refused;
        }
    }
  }
  EXPECT_GT(collapsed, 300);
  EXPECT_GT(refused, 10);
  expect_sphere(mesh);
  for (int v = 0; v < mesh.vertex_count(); ++v) {
    if (!mesh.vertex_alive(v)) continue;
    for (const int h : mesh.outgoing(v)) EXPECT_EQ(mesh.origin(h), v);
  }
}

}  // namespace
}  // namespace spherematch::samples
