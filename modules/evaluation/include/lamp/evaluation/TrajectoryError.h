#pragma once

#include <optional>
#include <vector>

#include "lamp/evaluation/Statistics.h"
#include "lamp/evaluation/TimeJoin.h"

namespace lamp::evaluation {

/** The error of each joined pose, in time order. */
struct TrajectoryError {
  std::vector<double> distance_m;    ///< travelled so far, on the true path
  std::vector<double> position_m;    ///< absolute trajectory error (Sturm et al. 2012)
  std::vector<double> rotation_deg;  ///< angle of truth⁻¹ · estimate

  void append(const TrajectoryError& other);
};
/** \param truth_T_estimate the alignment. */
TrajectoryError trajectoryError(const std::vector<JoinedPose>& poses,
                                const Pose3& truth_T_estimate);

/** Relative error over segments of a given length of the true path, one from each joined pose
 * (Geiger et al., KITTI, 2012), each by the length that it really has. */
struct Drift {
  std::vector<double> translation_percent;
  std::vector<double> rotation_deg_per_m;

  void append(const Drift& other);
  /** Means; none if the path is shorter than a segment. */
  std::optional<double> meanTranslation() const;
  std::optional<double> meanRotation() const;
};
/** Segments across estimated poses that have no true one are left out. Does not depend on the
 * alignment. */
Drift drift(const std::vector<JoinedPose>& poses, double segment_m);

}  // namespace lamp::evaluation
