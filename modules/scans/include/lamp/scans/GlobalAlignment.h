#pragma once

#include <optional>
#include <vector>

#include "lamp/core/Geometry.h"
#include "lamp/core/Options.h"
#include "lamp/scans/DescriptorMatching.h"

namespace lamp {

/** A relative pose on which keypoints agree. */
struct GlobalPose {
  Pose3 target_T_source = Pose3::Identity();
  size_t inliers = 0;       ///< matches that it brings together
  double inlier_ratio = 0;  ///< of all matches
};

struct ConsistencyOptions {
  int match_rank = 5;
  double noise_bound_m = 0.25;
  double max_normal_angle_deg = 30;
  int min_inliers = 6;
  int max_hypotheses = 3;
  bool upright = false;
  double guess_probability = 0.99;

  void visit(OptionVisitor& v);
};

/** A pose and how wrong it may be. */
struct UncertainPose {
  Pose3 target_T_source = Pose3::Identity();
  Matrix6d covariance = Matrix6d::Identity();  ///< tangent space at the pose
};

/** Poses found without a guess, by the recipe of TEASER (Yang et al., T-RO 2021): matches of
 * descriptors; those that are consistent in pairs, since a rigid motion keeps distances; a maximum
 * clique of them; its pose. The next hypothesis comes from the matches that the pose before leaves
 * over. Most inliers first; none if fewer than `min_inliers` ever agree.
 * \param guess where it is known how wrong a guess may be, matches beyond that are left out. */
std::vector<GlobalPose> alignByConsistency(const Features& source, const Features& target,
                                           const std::optional<UncertainPose>& guess,
                                           const ConsistencyOptions& options);

}  // namespace lamp
