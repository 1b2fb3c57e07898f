#include "engine/register/optical_flow.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/sphere/advection.h"

namespace spherematch {
namespace {

/// The smoothing after which degree `degree` is left with 1/`reduction` of its coefficient.
double cutoff_smoothing(int degree, double reduction) { return std::log(reduction) / (degree * (degree + 1.0)); }

void smooth(int degree, double time, Harmonics& coefficients) {
  scale_degrees(degree, coefficients, [time](int l) { return std::exp(-time * l * (l + 1)); });
}

/// The quadratic energy of one iteration.
class FlowSystem {
 public:
  FlowSystem(const HarmonicTransform& transform, const FlowPlan& plan)
      : transform_(transform),
        smoothness_(plan.smoothness()),
        tolerance_(plan.tolerance()),
        areas_(cell_areas(transform.resolution()).array()) {
    const int n = transform.resolution();
    tensor_[0] = tensor_[1] = tensor_[2] = Grid::Zero(n, n);
    right_ = {Grid::Zero(n, n), Grid::Zero(n, n)};
  }

  /// Adds one channel of both shapes, given by its coefficients.
  void add_channel(const Harmonics& source, const Harmonics& target, double weight) {
    const TangentGrid s = transform_.synthesize_tangent(source, {}), t = transform_.synthesize_tangent(target, {});
    const Grid difference = weight * transform_.synthesize(source - target);
    tensor_[0] += weight * (s.colatitude * s.colatitude + t.colatitude * t.colatitude);
    tensor_[1] += weight * (s.colatitude * s.longitude + t.colatitude * t.longitude);
    tensor_[2] += weight * (s.longitude * s.longitude + t.longitude * t.longitude);
    right_.colatitude += difference * (s.colatitude + t.colatitude);
    right_.longitude += difference * (s.longitude + t.longitude);
  }

  /// The stream function u of the minimiser.
  [[nodiscard]] Harmonics solve() {
    constexpr int kIterations = 100;
    for (Grid& component : tensor_) component.colwise() *= areas_;
    right_.colatitude.colwise() *= areas_;
    right_.longitude.colwise() *= areas_;
    const int degree = transform_.degree();
    Harmonics r;
    transform_.adjoint_tangent(right_, nullptr, &r);
    r[0] = 0;
    Harmonics u = Harmonics::Zero(r.size()), z = precondition(r), p = z;
    double rz = harmonic_dot(degree, r, z);
    const double stop = tolerance_ * tolerance_ * rz;
    for (int i = 0; i < kIterations && rz > stop && rz > 0; ++i) {
      const Harmonics ap = apply(p);
      const double step = rz / harmonic_dot(degree, p, ap);
      u += step * p;
      r -= step * ap;
      z = precondition(r);
      const double next = harmonic_dot(degree, r, z);
      p = z + (next / rz) * p;
      rz = next;
    }
    return u;
  }

 private:
  [[nodiscard]] double stiffness(int l) const { return smoothness_ * l * l * (l + 1.0) * (l + 1.0) + 1e-8; }

  /// By the smoothness alone. So the iterates grow from the smooth to the rough, and stopping early leaves the map smooth; a share of the
  /// data term here, whose strength differs a hundredfold over a shape, was slower.
  [[nodiscard]] Harmonics precondition(const Harmonics& r) const {
    Harmonics z = r;
    scale_degrees(transform_.degree(), z, [this](int l) { return 1 / stiffness(l); });
    return z;
  }

  [[nodiscard]] Harmonics apply(const Harmonics& u) const {
    const TangentGrid w = transform_.synthesize_tangent({}, u);
    const TangentGrid data{tensor_[0] * w.colatitude + tensor_[1] * w.longitude, tensor_[1] * w.colatitude + tensor_[2] * w.longitude};
    Harmonics result;
    transform_.adjoint_tangent(data, nullptr, &result);
    Harmonics smooth_part = u;
    scale_degrees(transform_.degree(), smooth_part, [this](int l) { return stiffness(l); });
    result += smooth_part;
    result[0] = 0;
    return result;
  }

  const HarmonicTransform& transform_;
  double smoothness_;
  double tolerance_;
  Eigen::ArrayXd areas_;
  Grid tensor_[3];     ///< weighted sum of g g^T over channels and shapes: (colatitude, colatitude), mixed, (longitude, longitude)
  TangentGrid right_;  ///< sum of (f_S - f_T) (grad f_S + grad f_T)
};

std::vector<Harmonics> level_signals(const FlowSide& side, const FlowPlan::Level& level) {
  std::vector<Harmonics> result = side.signals(level.level.channels, level.on_level, level.on_nodes);
  for (Harmonics& a : result) smooth(level.on_level.degree(), cutoff_smoothing(level.level.resolution / 2, 100), a);
  return result;
}

}  // namespace

FlowPlan::FlowPlan(FlowParameters parameters, int nodes)
    : smoothness_(parameters.smoothness), tolerance_(parameters.tolerance), settled_(parameters.settled), nodes_(nodes) {
  const auto solved = [&](const FlowLevel& level) { return std::min(level.resolution, parameters.finest_resolution); };
  int finest = 0;
  for (const FlowLevel& level : parameters.levels) finest = std::max(finest, solved(level));
  nodes_ = std::max(nodes_, finest);
  const HarmonicTransform on_nodes(nodes_, finest / 2 - 1);
  for (FlowLevel& level : parameters.levels) {
    const int resolution = solved(level), degree = resolution / 2 - 1;
    levels_.push_back({std::move(level), HarmonicTransform(resolution, degree), on_nodes.truncated(degree)});
  }
}

void flow_together(FlowSide& source, FlowSide& target, const FlowPlan& plan, const Progress& progress) {
  source.follow(plan.nodes());
  target.follow(plan.nodes());
  for (const FlowPlan::Level& level : plan.levels()) {
    const int degree = level.on_level.degree();
    for (int iteration = 0; iteration < level.level.iterations; ++iteration) {
      progress.check();
      const std::vector<Harmonics> f = level_signals(source, level), g = level_signals(target, level);
      FlowSystem system(level.on_level, plan);
      for (std::size_t c = 0; c < f.size(); ++c) system.add_channel(f[c], g[c], level.level.weights.empty() ? 1 : level.level.weights[c]);
      Harmonics stream = system.solve();
      smooth(degree, cutoff_smoothing(level.level.resolution / 2, 100.0 * level.level.resolution), stream);
      const TangentGrid step = level.on_nodes.synthesize_tangent({}, stream);
      const auto field = std::make_shared<const TangentField>(step);
      source.move(field, 0.5);
      target.move(field, -0.5);
      if ((step.colatitude.square() + step.longitude.square()).maxCoeff() < plan.settled() * plan.settled()) break;
    }
  }
}

}  // namespace spherematch
