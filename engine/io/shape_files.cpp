#include "engine/io/shape_files.h"

#include <array>
#include <charconv>
#include <stdexcept>
#include <vector>

#include "engine/io/array_writer.h"
#include "engine/io/mesh_writer.h"

namespace spherematch {

namespace {

constexpr std::string_view hks_prefix = "hks_";

struct HksSignal {
  double time = 0;
  const Eigen::MatrixXf* values = nullptr;
};

/// Those signals that are heat kernel signatures, in the order of the shape.
std::vector<HksSignal> hks_signals(const PreprocessedShape& shape) {
  std::vector<HksSignal> signals;
  for (const SignalGrid& grid : shape.signals) {
    if (!grid.name.starts_with(hks_prefix)) continue;
    HksSignal signal{.values = &grid.values};
    std::from_chars(grid.name.data() + hks_prefix.size(), grid.name.data() + grid.name.size(), signal.time);
    signals.push_back(signal);
  }
  return signals;
}

std::string grids_npy(const std::vector<HksSignal>& signals) {
  const Eigen::Index n = signals.empty() ? 0 : signals.front().values->rows();
  std::vector<float> numbers;
  numbers.reserve(signals.size() * static_cast<std::size_t>(n * n));
  for (const HksSignal& signal : signals) {
    if (signal.values->rows() != n || signal.values->cols() != n) throw std::invalid_argument("the grids of the shape differ in size");
    const Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> rows = *signal.values;
    numbers.insert(numbers.end(), rows.data(), rows.data() + rows.size());
  }
  return encode_npy("<f4", std::array<std::int64_t, 3>{static_cast<std::int64_t>(signals.size()), n, n}, std::as_bytes(std::span(numbers)));
}

}  // namespace

std::string encode_sphere_ply(PolygonMesh uploaded, const PreprocessedShape& shape) {
  if (uploaded.vertex_count() != shape.surface.uploaded_vertices()) {
    throw std::invalid_argument("the mesh has " + std::to_string(uploaded.vertex_count()) + " vertices and its shape " +
                                std::to_string(shape.surface.uploaded_vertices()));
  }
  uploaded.vertices = uploaded_sphere(shape);
  return encode_mesh(MeshFormat::ply, uploaded);
}

std::string encode_hks_npy(const PreprocessedShape& shape) { return grids_npy(hks_signals(shape)); }

std::string encode_hks_npz(const PreprocessedShape& shape) {
  const std::vector<HksSignal> signals = hks_signals(shape);
  std::vector<double> times;
  for (const HksSignal& signal : signals) times.push_back(signal.time);
  const std::array<std::int64_t, 1> length{static_cast<std::int64_t>(times.size())};
  return encode_npz(
      std::array<NamedArray, 2>{{{"times", encode_npy("<f8", length, std::as_bytes(std::span(times)))}, {"grids", grids_npy(signals)}}});
}

}  // namespace spherematch
