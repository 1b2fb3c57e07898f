// Parameters of every stage, with the defaults that measure best; paper() gives the paper's and the reference's constants.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string_view>
#include <vector>

namespace spherematch {

struct ReadLimits {
  std::int64_t max_vertices = 300'000;

  /// For a mesh that was accepted before, perhaps under another limit.
  static constexpr ReadLimits none() { return {.max_vertices = std::numeric_limits<std::int32_t>::max()}; }
};

struct PreprocessParameters {
  // Conformalised mean curvature flow (engine/sphere/conformal_flow.h)
  int conformal_steps = 100;
  double conformal_step_size = 0.4;      ///< at unit area with the standard cotangent stiffness
  double conformal_tolerance = 2e-3;     ///< a pass ends when a step moves points less than this on the sphere of unit area; 0 for never
  int conformal_coarse_vertices = 5000;  ///< a surface of clearly more flows as a copy of so many first; 0 for never
  int conformal_fine_steps = 1;          ///< of the surface itself after that
  int collapse_passes = 3;               ///< reweighted passes against the collapse of limbs; 0 for the plain conformal map
  int collapse_steps = 10;               ///< flow steps in each pass
  double collapse_threshold = 0.3;       ///< linear scale below which a region counts as collapsed

  // Authalic evolution (engine/sphere/authalic_evolution.h)
  int authalic_resolution = 160;
  int authalic_steps = 50;              ///< with their size the time of the evolution; shorter steps are more
  double authalic_step_size = 0.01;     ///< stable below 2 e tau
  double authalic_longest_move = 0.05;  ///< radians: steps that would move points further are shortened, by 20 at most
  double authalic_smoothing = 0.0025;   ///< tau: coefficient l is damped by exp(-tau l (l + 1))
  bool exact_rasterization = false;     ///< the slower way to the area density, for comparison (engine/sphere/rasterizer.h)

  // Eigenbasis and signals (engine/spectrum)
  int eigenpairs = 200;
  bool multilevel_eigenbasis = true;   ///< by subspaces on ever finer meshes; otherwise, at full size (engine/spectrum/eigenbasis.h)
  bool single_vector_lanczos = false;  ///< the slowest eigensolver, for comparison
  std::vector<double> hks_times{1.0, 0.5, 0.25, 0.125, 0.0625, 0.01};
  int signal_resolution = 128;

  /// @throws EngineError(invalid_parameter) naming the field and the reason
  void validate() const;
  static PreprocessParameters paper();
};

/// Which way round the source is matched: as it is, as its mirror image (left bone to right bone), or as what scores better.
enum class Orientation { preserve, reverse, any };

/// Uploaded vertex `source` of the source belongs to uploaded vertex `target` of the target; roughly is enough.
struct Hint {
  std::int32_t source = 0;
  std::int32_t target = 0;
  bool operator==(const Hint&) const = default;
};

/// Of "12:40,77:3": source and target of each hint, numbered from 0. Empty for an empty text.
/// @throws EngineError(invalid_parameter) whose text begins with "hints: "
[[nodiscard]] std::vector<Hint> parse_hints(std::string_view text);

struct MatchParameters {
  static constexpr std::size_t max_hints = 64;

  // Rotational alignment (engine/register/rotation.h)
  /// Heat kernel signature time of the rotation signal; the signal at half of it counts as well, unless paper_selection is set.
  double rotation_time = 1.0;
  int rotation_bandwidth = 18;
  int max_candidates = 8;             ///< K
  double candidate_separation = 1.5;  ///< epsilon_1: squared Frobenius distance to a better candidate
  double candidate_threshold = 0.3;   ///< epsilon_2: fraction of the best correlation that may be missing

  // Optical flow (engine/register/optical_flow.h): level i has resolution flow_resolution * 2^i and the signal of flow_times[i]
  std::vector<double> flow_times{0.5, 0.25, 0.125, 0.0625};
  int flow_resolution = 16;
  int flow_iterations = 4;        ///< per level, at most
  int flow_repeated = 1;          ///< how many levels of the coarser half are gone through once more, with the best candidates
  double flow_settled = 0.02;     ///< radians: a level ends with the first step that moves no point farther
  double flow_smoothness = 0.05;  ///< alpha
  int finest_flow = 64;           ///< resolution above which no level is solved; its smoothing stays that of the level
  double flow_tolerance = 0.1;    ///< of each solve, on the residual
  double flow_detail = 1;         ///< weight of the logarithms of signatures at small times, beside a level's own signal
  int flow_detail_from = 1;       ///< the first level where they count
  bool mesh_flow = false;         ///< rasterises the moved meshes at each iteration as the paper does: slower, for comparison

  // Elastic flow (engine/register/elastic_flow.h)
  std::vector<int> elastic_iterations{4, 8};  ///< at most, on icospheres of 2562, 10242, 40962 nodes; none for the optical flow alone
  double elastic_area = 1;                    ///< weight of changes of area, against that of losses of shape
  double elastic_yield = 1;                   ///< strain from which a triangle resists less and less
  double elastic_signals = 25;                ///< weight of differences of signals
  double elastic_signal_yield = 0.5;          ///< multiple of their mean square from which these resist less and less
  double elastic_spectrum = 5;                ///< weight of differences of eigenfunctions from their functional map's; zero for none
  int elastic_eigenfunctions = 20;            ///< how many, in the first step of a level
  int elastic_more_eigenfunctions = 5;        ///< in each further step
  double elastic_longest_move = 0.1;          ///< radians, of a node in a step
  double elastic_settled = 0.005;             ///< radians: a level ends with the first step that would move no node farther

  // Candidate selection (engine/register/selection.h)
  int fine_candidates = 2;       ///< only this many best ones go on after the coarser half of the levels
  bool paper_selection = false;  ///< by the one signal at time 0.01, as the paper does

  // What the caller wants and knows
  Orientation orientation = Orientation::preserve;
  std::vector<Hint> hints;  ///< at most max_hints; they pick and guide the candidate
  bool both = false;        ///< also the map from target to source
  int candidate = 0;        ///< which map: of the best rotation, or of the next best ones that went through the whole flow

  /// @throws EngineError(invalid_parameter) naming the field and the reason
  void validate() const;
  static MatchParameters paper();
};

}  // namespace spherematch
