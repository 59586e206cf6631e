#include "lamp/registration/SacIa.h"

IMPLEMENTS_MRPT_OBJECT(SacIa, lamp::InitialAligner, lamp)

namespace lamp {

AlignmentResult SacIa::align(const PreparedScan& source, const PreparedScan& target,
                             const Guess&) const {
  if (source.planar() || target.planar()) return {{}, "planar scans have no descriptors"};
  const auto pose = alignBySamples(source.features(), target, options);
  if (!pose) return {{}, "too few keypoints"};
  return {{Hypothesis{pose->target_T_source, pose->inliers, pose->inlier_ratio, std::nullopt}}, ""};
}

}  // namespace lamp
