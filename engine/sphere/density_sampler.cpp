#include "engine/sphere/density_sampler.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "engine/sphere/grid_place.h"

namespace spherematch {
namespace {

constexpr double kSpacing = 1.0;  ///< of samples, in heights of a row: half of it measures no better, twice is rough on coarse meshes

}  // namespace

/// Gathers samples and spreads them in batches, so that their places are computed side by side.
class SampleSpreader {
 public:
  SampleSpreader(const std::vector<DensitySampler::Row>& rows, std::vector<double>& cells)
      : rows_(rows), resolution_(static_cast<int>(rows.size())), cells_(cells) {}

  void add(double x, double y, double z, double mass) {
    x_[count_] = x;
    y_[count_] = y;
    z_[count_] = z;
    mass_[count_] = mass;
    if (++count_ == kBatch) flush();
  }

  void flush() {
    std::array<double, kBatch> row, turn;
    const double resolution = resolution_;
    for (std::size_t i = 0; i < kBatch; ++i) {  // those past the count are left from before, and harmless
      const GridPlace place = grid_place(x_[i], y_[i], z_[i]);
      row[i] = place.colatitude * resolution + 0.5;
      turn[i] = place.longitude;
    }
    for (std::size_t i = 0; i < count_; ++i) {
      const int lower = static_cast<int>(row[i]);
      const double lower_share = row[i] - lower;
      spread(lower - 1, turn[i], (1 - lower_share) * mass_[i]);
      spread(lower, turn[i], lower_share * mass_[i]);
    }
    count_ = 0;
  }

 private:
  void spread(int row, double turn, double mass) {
    if (row < 0 || row >= resolution_) {  // beyond a pole lies the opposite meridian
      row = row < 0 ? 0 : resolution_ - 1;
      turn += turn < 0.5 ? 0.5 : -0.5;
    }
    const auto& r = rows_[static_cast<std::size_t>(row)];
    const double column = turn * r.columns + 0.5;  // counted from the one left of the first
    const int next = static_cast<int>(column);
    const double share = column - next;
    const int left = next > 0 ? next - 1 : r.columns - 1, right = next < r.columns ? next : 0;
    double* cells = cells_.data() + r.start;
    cells[left] += (1 - share) * mass;
    cells[right] += share * mass;
  }

  static constexpr std::size_t kBatch = 256;
  const std::vector<DensitySampler::Row>& rows_;
  int resolution_;
  std::vector<double>& cells_;
  std::array<double, kBatch> x_{}, y_{}, z_{}, mass_{};
  std::size_t count_ = 0;
};

namespace {

/// Samples of the flat triangle over the altitude from `foot` to `top` that ends in `corner`, about `spacing` apart: strips parallel to
/// the altitude, whose masses follow their widths, in equal parts. The distances are those from `foot`.
void sample_half(const Eigen::Vector3d& foot, const Eigen::Vector3d& top, const Eigen::Vector3d& corner, double height, double length,
                 double mass, double spacing, SampleSpreader& spreader) {
  const int strips = std::max(1, static_cast<int>(std::ceil(length / spacing)));
  for (int i = 0; i < strips; ++i) {
    const double near = 1 - static_cast<double>(i) / strips, far = 1 - static_cast<double>(i + 1) / strips;  // widths
    const double centre = 1 - near + (near + 2 * far) / (3 * strips * (near + far)), width = 1 - centre;
    const int samples = std::max(1, static_cast<int>(std::ceil(width * height / spacing)));
    const Eigen::Vector3d from = foot + centre * (corner - foot), step = width / samples * (top - foot);
    const double share = mass * (near - far) * (near + far) / samples;
    for (int k = 0; k < samples; ++k) {
      const Eigen::Vector3d s = from + (k + 0.5) * step;
      spreader.add(s[0], s[1], s[2], share);
    }
  }
}

/// Samples of a flat triangle; their masses add up to `mass`.
void sample_face(const Eigen::Vector3d& p, const Eigen::Vector3d& q, const Eigen::Vector3d& r, double mass, double spacing,
                 SampleSpreader& spreader) {
  const double pq = (q - p).squaredNorm(), qr = (r - q).squaredNorm(), rp = (p - r).squaredNorm();
  const double longest = std::max({pq, qr, rp});
  if (longest <= spacing * spacing) {
    const Eigen::Vector3d sum = p + q + r;
    spreader.add(sum[0], sum[1], sum[2], mass);
    return;
  }
  const bool over_qr = longest == qr, over_rp = !over_qr && longest == rp;
  const Eigen::Vector3d &top = over_qr ? p : over_rp ? q : r, &left = over_qr ? q : over_rp ? r : p, &right = over_qr ? r : over_rp ? p : q;
  const double split = std::clamp((top - left).dot(right - left) / longest, 0.0, 1.0), length = std::sqrt(longest);
  const Eigen::Vector3d foot = left + split * (right - left);
  const double height = (top - foot).norm();
  sample_half(foot, top, left, height, split * length, split * mass, spacing, spreader);
  sample_half(foot, top, right, height, (1 - split) * length, (1 - split) * mass, spacing, spreader);
}

}  // namespace

DensitySampler::DensitySampler(int resolution) : resolution_(resolution) {
  const int count = resolution / 2;
  const double h = std::numbers::pi / count;
  std::size_t start = 0;
  for (int j = 0; j < count; ++j) {
    const int columns = std::clamp(static_cast<int>(std::ceil(2 * count * std::sin((j + 0.5) * h))), 4, resolution);
    // The integral of the row's hat function; a polar row's hat stays at one up to the pole.
    const double hat = 2 * std::sin((j + 0.5) * h) * (1 - std::cos(h)) / h;
    const double polar = 1 - (std::sin(1.5 * h) - std::sin(0.5 * h)) / h;
    rows_.push_back({columns, start, 2 * std::numbers::pi / columns * (j == 0 || j == count - 1 ? polar : hat)});
    start += static_cast<std::size_t>(columns);
  }
}

std::vector<double> DensitySampler::masses(const Points& sphere, const Triangles& faces, const Eigen::VectorXd& face_mass) const {
  std::vector<double> cells(rows_.back().start + static_cast<std::size_t>(rows_.back().columns), 0.0);
  SampleSpreader spreader(rows_, cells);
  const double spacing = kSpacing * std::numbers::pi / static_cast<double>(rows_.size());
  for (Eigen::Index f = 0; f < faces.rows(); ++f)
    sample_face(sphere.row(faces(f, 0)), sphere.row(faces(f, 1)), sphere.row(faces(f, 2)), face_mass[f], spacing, spreader);
  spreader.flush();
  return cells;
}

Grid DensitySampler::log_density(const Points& sphere, const Triangles& faces, const Eigen::VectorXd& face_mass, double floor) const {
  std::vector<double> cells = masses(sphere, faces, face_mass);
  const Eigen::Index n = resolution_, count = n / 2;
  Grid rows(count + 2, n);  // and beyond each pole the opposite meridian
  for (Eigen::Index j = 0; j < count; ++j) {
    const Row& row = rows_[static_cast<std::size_t>(j)];
    double* values = cells.data() + row.start;
    for (int i = 0; i < row.columns; ++i) values[i] = std::log(values[i] / row.weight + floor);
    for (int i = 0; i < resolution_; ++i) {
      const double column = (i + 0.5) * row.columns / resolution_ + 0.5;  // counted from the one left of the first
      const int right = static_cast<int>(column);
      const double share = column - right;
      rows(j + 1, i) = (1 - share) * values[right > 0 ? right - 1 : row.columns - 1] + share * values[right < row.columns ? right : 0];
    }
  }
  rows.row(0) << rows.row(1).tail(count), rows.row(1).head(count);
  rows.row(count + 1) << rows.row(count).tail(count), rows.row(count).head(count);
  Grid result(n, n);
  for (Eigen::Index j = 0; j < count; ++j) {
    result.row(2 * j) = 0.25 * rows.row(j) + 0.75 * rows.row(j + 1);
    result.row(2 * j + 1) = 0.75 * rows.row(j + 1) + 0.25 * rows.row(j + 2);
  }
  return result;
}

}  // namespace spherematch
