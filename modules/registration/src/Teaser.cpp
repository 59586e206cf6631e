#include "lamp/registration/Teaser.h"

IMPLEMENTS_MRPT_OBJECT(Teaser, lamp::InitialAligner, lamp)

namespace lamp {

AlignmentResult Teaser::align(const PreparedScan& source, const PreparedScan& target,
                              const Guess& guess) const {
  if (source.planar() || target.planar()) return {{}, "planar scans have no descriptors"};
  std::optional<UncertainPose> known;
  if (guess.covariance) known = UncertainPose{guess.target_T_source, *guess.covariance};
  AlignmentResult result;
  for (const GlobalPose& pose :
       alignByConsistency(source.features(), target.features(), known, options))
    result.hypotheses.push_back(
        {pose.target_T_source, pose.inliers, pose.inlier_ratio, 2 * options.noise_bound_m});
  if (result.hypotheses.empty()) result.refusal = "too few consistent matches";
  return result;
}

}  // namespace lamp
