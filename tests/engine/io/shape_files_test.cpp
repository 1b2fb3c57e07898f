#include "engine/io/shape_files.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <stdexcept>

#include "engine/io/array_reader.h"
#include "engine/io/array_writer.h"
#include "tests/engine/io/some_maps.h"

namespace spherematch::test {
namespace {

PreprocessedShape shape_of(const PolygonMesh& upload) {
  PreprocessedShape shape;
  shape.surface = repair(upload, RepairMode::fill);
  shape.sphere = shape.surface.mesh.vertices.rowwise().normalized();
  for (const double time : {1.0, 0.0625, 0.01}) shape.signals.push_back({hks_name(time), Eigen::MatrixXf(3, 3)});
  float next = 0;
  for (SignalGrid& signal : shape.signals)
    for (Eigen::Index row = 0; row < 3; ++row)
      for (Eigen::Index column = 0; column < 3; ++column) signal.values(row, column) = next++;
  return shape;
}

TEST(ShapeFiles, TheSphereSpeaksOfUploadedVertices) {
  const PolygonMesh upload = sphere_and_stray();
  const PreprocessedShape shape = shape_of(upload);
  const Points points = uploaded_sphere(shape);
  ASSERT_EQ(points.rows(), 166);
  EXPECT_LT((points.topRows(162) - upload.vertices.topRows(162)).cwiseAbs().maxCoeff(), 1e-15);
  EXPECT_TRUE(points.bottomRows(4).array().isNaN().all());

  const std::string ply = encode_sphere_ply(upload, shape);
  const std::size_t rows = ply.find("end_header\n") + 11;
  EXPECT_NE(ply.find("property double x"), std::string::npos);
  EXPECT_EQ(std::memcmp(ply.data() + rows, points.data(), sizeof(double) * 3 * 166), 0);
  EXPECT_EQ(ply.size(), rows + sizeof(double) * 3 * 166 + upload.offsets.size() - 1 + 4 * upload.indices.size());
  EXPECT_THROW((void)encode_sphere_ply(cube(), shape), std::invalid_argument);
}

TEST(ShapeFiles, SignalsAreRowsOfColatitude) {
  PreprocessedShape shape = shape_of(polygons(icosphere(1)));
  shape.signals.insert(shape.signals.begin(), {"other", Eigen::MatrixXf::Zero(9, 9)});
  const Array grids = decode_npy(encode_hks_npy(shape));
  EXPECT_EQ(grids.dtype, "<f4");
  EXPECT_EQ(grids.shape, (std::vector<std::int64_t>{3, 3, 3}));
  for (std::size_t i = 0; i < 27; ++i) {
    float number = 0;
    std::memcpy(&number, grids.bytes.data() + 4 * i, 4);
    EXPECT_EQ(number, static_cast<float>(i));
  }
  // The archive's first file holds the times.
  const std::string npz = encode_hks_npz(shape);
  const std::size_t start = npz.find("\x93NUMPY");
  const std::size_t size = encode_npy("<f8", std::array<std::int64_t, 1>{3}, {}).size() + 24;
  const Array times = decode_npy(npz.substr(start, size));
  double values[3];
  std::memcpy(values, times.bytes.data(), sizeof values);
  EXPECT_EQ(values[0], 1);
  EXPECT_EQ(values[1], 0.0625);
  EXPECT_EQ(values[2], 0.01);
  EXPECT_NE(npz.find(encode_hks_npy(shape)), std::string::npos);

  shape.signals.back().values.resize(4, 4);
  EXPECT_THROW((void)encode_hks_npy(shape), std::invalid_argument);
}

}  // namespace
}  // namespace spherematch::test
