// SPDX-License-Identifier: MIT
// Body and answer of POST /evaluations; docs/http.md and docs/evaluation.md explain every member. Plain values, no behaviour.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace spherematch::api {

/// Vertices of equal number belong together.
struct IdentityTruth {
  bool operator==(const IdentityTruth&) const = default;
};
/// targets[i] belongs to vertex i of src; -1 where that is not known, whatever the base.
struct IndexTruth {
  std::vector<std::int32_t> targets;
  bool operator==(const IndexTruth&) const = default;
};
/// source[i] belongs to target[i], and mirrored[i] is the place of target[i] with left and right exchanged. Equally long.
struct LandmarkTruth {
  std::vector<std::int32_t> source;
  std::vector<std::int32_t> target;
  std::optional<std::vector<std::int32_t>> mirrored;
  bool operator==(const LandmarkTruth&) const = default;
};
using Truth = std::variant<std::monostate, IdentityTruth, IndexTruth, LandmarkTruth>;

struct EvaluationRequest {
  std::string src;
  std::string tgt;
  Truth truth;             ///< std::monostate where none is known
  std::int32_t base = 0;   ///< 0 or 1: what vertex numbers in the truth count from
  bool both = true;        ///< match in both directions
  bool biharmonic = true;  ///< biharmonic distances as well
  std::vector<std::array<std::int32_t, 2>> hints;
  std::string method = "default";
  std::string refine = "default";  ///< or "none": without the elastic flow
  std::string orientation = "preserve";
  std::int32_t candidate = 0;  ///< 0: of the best rotation, 1: of the next best
  bool operator==(const EvaluationRequest&) const = default;
};

struct MapError {
  double mean = 0;
  double median = 0;
  double p95 = 0;
  double max = 0;
  double auc = 0;
  std::optional<double> area_mean{};  ///< where the landmarks are dense
  std::int32_t scored = 0;
  std::int32_t unscored = 0;
  std::vector<double> curve{};  ///< one for each of Evaluation::thresholds, or none where nothing was scored
  bool operator==(const MapError&) const = default;
};

struct Continuity {
  std::int32_t edges = 0;
  std::int32_t torn = 0;
  double edge_distortion = 0;
  double stretch_median = 0;
  double stretch_p95 = 0;
  double stretch_max = 0;
  double dirichlet = 0;
  double turned = 0;
  bool operator==(const Continuity&) const = default;
};

struct Coverage {
  double area = 0;
  double vertices = 0;
  bool operator==(const Coverage&) const = default;
};

/// What could not be measured is absent; in JSON it is null.
struct Evaluation {
  std::string src;
  std::string tgt;
  std::optional<MapError> geodesic;
  std::optional<MapError> mirrored;
  std::optional<bool> flipped;
  std::optional<MapError> biharmonic;
  std::optional<double> symmetric_integral;
  Continuity continuity;
  Coverage coverage;
  std::optional<MapError> bijectivity;
  std::optional<MapError> bijectivity_biharmonic;
  std::vector<double> thresholds;
  std::string orientation = "preserve";                 ///< or "reverse": the mirror image of src was matched
  std::vector<std::pair<std::string, double>> seconds;  ///< of the measurement
  bool cached = false;                                  ///< the match was
  std::string engine;
  bool operator==(const Evaluation&) const = default;
};

}  // namespace spherematch::api
