// Shapes for the tests of storage: the store looks at sizes and indices only, so these need not be real surfaces.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "engine/data/preprocessed_shape.h"
#include "storage/error.h"

namespace spherematch::testing {

template <typename Matrix>
Matrix random_matrix(std::mt19937& random, Eigen::Index rows, Eigen::Index columns) {
  using Scalar = typename Matrix::Scalar;
  std::normal_distribution<Scalar> normal;
  return Matrix::NullaryExpr(rows, columns, [&] { return normal(random); });
}

inline Triangles random_triangles(std::mt19937& random, Eigen::Index rows, std::int32_t low, std::int32_t high) {
  std::uniform_int_distribution<std::int32_t> index(low, high);
  return Triangles::NullaryExpr(rows, 3, [&] { return index(random); });
}

inline Surface sample_surface(std::int32_t vertices = 12, unsigned seed = 1) {
  std::mt19937 random(seed);
  Surface surface;
  const Eigen::Index faces = 2 * Eigen::Index{vertices} - 4;
  const std::int32_t uploaded = vertices + 3;
  surface.mesh.vertices = random_matrix<Points>(random, vertices, 3);
  surface.mesh.vertices(0, 0) = -0.0;
  surface.mesh.vertices(0, 1) = std::numeric_limits<double>::denorm_min();
  surface.mesh.faces = random_triangles(random, faces, 0, vertices - 1);
  surface.uploaded_corners = random_triangles(random, faces, -1, uploaded - 1);
  std::uniform_int_distribution<std::int32_t> vertex(-1, vertices - 1);
  for (std::int32_t i = 0; i < uploaded; ++i) surface.surface_vertex.push_back(vertex(random));
  surface.uploaded_faces = static_cast<std::int32_t>(faces) - 2;
  surface.report = {1, 2, 3, 4, 5, 6, 7, 8, static_cast<std::int32_t>(seed)};
  return surface;
}

/// Of about half the vertices.
inline DecimatedMesh sample_decimated(const Surface& surface, unsigned seed = 7) {
  std::mt19937 random(seed);
  const auto vertices = static_cast<std::int32_t>(surface.mesh.vertex_count() / 2);
  DecimatedMesh decimated;
  decimated.mesh.vertices = random_matrix<Points>(random, vertices, 3);
  decimated.mesh.faces = random_triangles(random, 2 * Eigen::Index{vertices} - 4, 0, vertices - 1);
  std::uniform_int_distribution<std::int32_t> face(0, 2 * vertices - 5);
  for (Eigen::Index v = 0; v < surface.mesh.vertex_count(); ++v) decimated.places.push_back({face(random), {0.5, 0.25, 0.25}});
  decimated.seconds = 0.125;
  return decimated;
}

/// Different for each seed in every part.
inline PreprocessedShape sample_prepared(const Surface& surface, unsigned seed = 1, Eigen::Index eigenpairs = 5, Eigen::Index grid = 4) {
  std::mt19937 random(seed);
  const Eigen::Index vertices = surface.working_mesh().vertex_count();
  PreprocessedShape shape;
  shape.surface = surface;
  shape.surface.report.dropped_components = static_cast<std::int32_t>(seed);
  shape.sphere = random_matrix<Points>(random, vertices, 3);
  shape.sphere_quality = {static_cast<std::int32_t>(seed), 1e-13 * seed, 0.1 + seed};
  shape.eigenvalues = random_matrix<Eigen::VectorXd>(random, eigenpairs, 1);
  shape.eigenvectors = random_matrix<Eigen::MatrixXf>(random, vertices, eigenpairs);
  for (const char* name : {"hks_1", "hks_0.0625"}) shape.signals.push_back({name, random_matrix<Eigen::MatrixXf>(random, grid, grid)});
  shape.seconds = {{"conformal", 0.25 + seed}, {"authalic", 1.0 / 3.0}, {"total", 2.5}};
  shape.engine = "engine-" + std::to_string(seed);
  return shape;
}

/// Bit for bit, so that a lost not-a-number or sign of zero shows.
template <typename Matrix>
bool same_bits(const Matrix& a, const Matrix& b) {
  const auto size = static_cast<std::size_t>(a.size()) * sizeof(typename Matrix::Scalar);
  return a.rows() == b.rows() && a.cols() == b.cols() && (size == 0 || std::memcmp(a.data(), b.data(), size) == 0);
}

inline void expect_same(const Surface& a, const Surface& b) {
  EXPECT_TRUE(same_bits(a.mesh.vertices, b.mesh.vertices));
  EXPECT_TRUE(same_bits(a.mesh.faces, b.mesh.faces));
  EXPECT_TRUE(same_bits(a.uploaded_corners, b.uploaded_corners));
  EXPECT_EQ(a.surface_vertex, b.surface_vertex);
  EXPECT_EQ(a.uploaded_faces, b.uploaded_faces);
  EXPECT_EQ(a.report, b.report);
  ASSERT_EQ(a.decimated.has_value(), b.decimated.has_value());
  if (!a.decimated) return;
  EXPECT_TRUE(same_bits(a.decimated->mesh.vertices, b.decimated->mesh.vertices));
  EXPECT_TRUE(same_bits(a.decimated->mesh.faces, b.decimated->mesh.faces));
  EXPECT_EQ(a.decimated->seconds, b.decimated->seconds);
  ASSERT_EQ(a.decimated->places.size(), b.decimated->places.size());
  for (std::size_t v = 0; v < a.decimated->places.size(); ++v) {
    EXPECT_EQ(a.decimated->places[v].face, b.decimated->places[v].face);
    EXPECT_EQ(a.decimated->places[v].weights, b.decimated->places[v].weights);
  }
}

inline void expect_same(const PreprocessedShape& a, const PreprocessedShape& b) {
  expect_same(a.surface, b.surface);
  EXPECT_TRUE(same_bits(a.sphere, b.sphere));
  EXPECT_EQ(a.sphere_quality.flipped, b.sphere_quality.flipped);
  EXPECT_EQ(a.sphere_quality.solid_angle_defect, b.sphere_quality.solid_angle_defect);
  EXPECT_EQ(a.sphere_quality.area_distortion, b.sphere_quality.area_distortion);
  EXPECT_TRUE(same_bits(a.eigenvalues, b.eigenvalues));
  EXPECT_TRUE(same_bits(a.eigenvectors, b.eigenvectors));
  ASSERT_EQ(a.signals.size(), b.signals.size());
  for (std::size_t i = 0; i < a.signals.size(); ++i) {
    EXPECT_EQ(a.signals[i].name, b.signals[i].name);
    EXPECT_TRUE(same_bits(a.signals[i].values, b.signals[i].values));
  }
  EXPECT_EQ(a.seconds, b.seconds);
  EXPECT_EQ(a.engine, b.engine);
}

/// The code of the StorageError that the call throws; fails the test when it throws none.
template <typename Call>
StorageErrorCode error_of(Call call) {
  try {
    call();
  } catch (const StorageError& error) {
    EXPECT_STRNE(error.what(), "");
    return error.code();
  }
  ADD_FAILURE() << "no StorageError was thrown";
  return StorageErrorCode::io;
}

}  // namespace spherematch::testing
