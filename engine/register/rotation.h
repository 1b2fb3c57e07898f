// Rotational alignment by correlation over SO(3) (paper section 4.3).
#pragma once

#include <Eigen/Core>
#include <vector>

#include "engine/data/parameters.h"
#include "engine/sphere/harmonics.h"

namespace spherematch {

struct RotationCandidate {
  Eigen::Matrix3d rotation;  ///< turns the source sphere onto the target sphere
  double correlation;        ///< normalised: 1 for equal signals
};

/// Local maxima of the correlation <f(R^-1 .), g> over all rotations, by falling correlation, each refined by Newton's method
/// on the exact trigonometric sum; kept when separated from every better one and close enough to the best
/// (candidate_separation, candidate_threshold, max_candidates). `source` and `target` hold one or more signals each, of the
/// given degree; every signal counts alike and its mean does not count. At least one candidate is returned.
[[nodiscard]] std::vector<RotationCandidate> align_rotations(const std::vector<Harmonics>& source, const std::vector<Harmonics>& target,
                                                             int degree, const MatchParameters& parameters);

/// The correlation at one rotation, of signals as above.
[[nodiscard]] double rotation_correlation(const std::vector<Harmonics>& source, const std::vector<Harmonics>& target, int degree,
                                          const Eigen::Matrix3d& rotation);

/// The rotation by half the angle about the same axis.
[[nodiscard]] Eigen::Matrix3d half_rotation(const Eigen::Matrix3d& rotation);

}  // namespace spherematch
