// Ground truth, and how good a map is.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "engine/data/preprocessed_shape.h"

namespace spherematch {

/// Uploaded vertex `source` of one shape belongs to uploaded vertex `target` of the other.
struct Landmark {
  std::int32_t source = 0;
  std::int32_t target = 0;
};

struct GroundTruth {
  std::vector<Landmark> direct;    ///< empty where no truth is known
  std::vector<Landmark> mirrored;  ///< left and right exchanged: a map that comes closer to these is flipped; may be empty
  bool dense = false;              ///< `direct` speaks of (nearly) every vertex, so that integrals over the surface can be taken
};

/// Every vertex belongs to the one of the same number. @throws EngineError(invalid_parameter) where the two counts differ
[[nodiscard]] GroundTruth identity_truth(std::int32_t source_vertices, std::int32_t target_vertices);
/// `targets[i]` belongs to source vertex i; -1 where that is not known.
[[nodiscard]] GroundTruth index_truth(const std::vector<std::int32_t>& targets);
/// Row i of one list belongs to row i of the other. @throws EngineError(invalid_parameter) where their lengths differ
[[nodiscard]] std::vector<Landmark> paired(const std::vector<std::int32_t>& sources, const std::vector<std::int32_t>& targets);

/// Cumulative curves have their values at 0, 0.0025, ... 0.25.
inline constexpr int curve_steps = 100;
inline constexpr double curve_end = 0.25;
[[nodiscard]] std::vector<double> curve_thresholds();

/// Distances between images and truth. Geodesic ones are divided by the square root of the area that they lie on, and biharmonic ones
/// are those of the surface at unit area. All zero when nothing was scored. But for `area_mean`, landmarks count alike, whatever area they
/// stand for.
struct MapError {
  double mean = 0;
  double median = 0;
  double p95 = 0;
  double max = 0;
  double auc = 0;                     ///< area under the cumulative curve from 0 to curve_end, divided by curve_end: 1 for a perfect map
  std::vector<double> curve{};        ///< (curve_steps + 1): fraction of the distances that are at most each threshold; empty if none
  std::optional<double> area_mean{};  ///< by the area of the source round each vertex; where the landmarks are dense
  std::int32_t scored = 0;            ///< landmarks that the figures are about
  std::int32_t unscored = 0;          ///< landmarks at a dropped vertex of either shape
};

/// What the map does to the edges and faces of the source. Lengths are relative to the square roots of the areas, so that an isometry
/// has stretch 1 everywhere.
struct Continuity {
  std::int32_t edges = 0;      ///< of the uploaded mesh, with an image at both ends
  std::int32_t torn = 0;       ///< edges more than 5 times as long as before, and longer than 0.05
  double edge_distortion = 0;  ///< mean of |stretch - 1|
  double stretch_median = 0;   ///< geodesic distance of the ends' images over the edge's length
  double stretch_p95 = 0;
  double stretch_max = 0;
  double dirichlet = 0;  ///< Dirichlet energy of the images' positions; 1 for an isometry, and at least the area that is covered
  double turned = 0;     ///< share of the source's area whose faces land the other way round than most
};

/// How much of the target is the image of something.
struct Coverage {
  double area = 0;      ///< share of the uploaded area on which images of source faces lie
  double vertices = 0;  ///< share of the uploaded vertices that are the nearest one to the image of a source vertex
};

/// Members that need what is not there are absent.
struct Evaluation {
  std::optional<MapError> geodesic;          ///< with a truth
  std::optional<MapError> mirrored;          ///< geodesic, against the mirrored truth
  std::optional<bool> flipped;               ///< the mean error against the mirrored truth is the smaller one
  std::optional<MapError> biharmonic;        ///< with a truth and the target's eigenbasis
  std::optional<double> symmetric_integral;  ///< D(S, T) of the paper (section 5.1): with a dense truth, both maps and both eigenbases
  Continuity continuity;
  Coverage coverage;
  std::optional<MapError> bijectivity;             ///< with both maps: from a vertex to its image and back, geodesic, on the source
  std::optional<MapError> bijectivity_biharmonic;  ///< with the source's eigenbasis as well
  StageSeconds seconds;                            ///< "errors", "continuity", "coverage", "bijectivity", "total"
};

/// What to think of a map at each vertex. Entry i is uploaded source vertex i. Both are 0 for a dropped vertex.
struct VertexQuality {
  /// How much the map stretches and shrinks: the square root of the mean square of the logarithms of the singular values, over the faces
  /// round the vertex, of the map between both surfaces at unit area. 0 for an isometry, log 2 = 0.7 for twice the size; at most 3.
  std::vector<float> distortion;
  /// The probability that the image is right to 3 percent of the square root of the target's area, estimated from the distortion there,
  /// that of the whole map, and how different the signals of vertex and image are. docs/method.md tells how well that goes.
  std::vector<float> confidence;
};

}  // namespace spherematch
