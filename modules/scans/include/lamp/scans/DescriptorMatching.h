#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "lamp/scans/Features.h"

namespace lamp {

/** A keypoint of the source and one of the target that look alike. */
struct Match {
  uint32_t source = 0, target = 0;

  friend bool operator==(const Match& a, const Match& b) {
    return a.source == b.source && a.target == b.target;
  }
};

/** Where the partner of each of the source's keypoints can only lie, in the target's frame. */
struct Whereabouts {
  std::vector<Eigen::Vector3f> centers;
  std::vector<float> radii;  ///< metres
};

/** Pairs of keypoints each of which is among the `rank` most similar ones of the other; 1 gives
 * mutual nearest neighbours. Sorted by source, then target.
 * \param whereabouts if given, others than the keypoints there are not looked at. */
std::vector<Match> mutualMatches(const Features& source, const Features& target, int rank,
                                 const std::optional<Whereabouts>& whereabouts = {});

/** The `count` target keypoints that look most like each keypoint of the source, the best first:
 * column k holds those of source keypoint k. */
Eigen::Matrix<uint32_t, Eigen::Dynamic, Eigen::Dynamic> mostSimilar(const Features& source,
                                                                    const Features& target,
                                                                    int count);

}  // namespace lamp
