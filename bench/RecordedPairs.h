#pragma once

#include <string>
#include <vector>

#include "lamp/core/Geometry.h"
#include "lamp/scans/Cloud.h"

namespace lamp {

/** Two scans of one robot, thinned as the front end thins them; the second one is moved so that
 * nothing is known of their relative pose. */
struct RecordedPair {
  Cloud target, source;
  Pose3 target_T_source = Pose3::Identity();  ///< from the recorded odometry
  double overlap = 0;                         ///< of the scans before they were thinned
};

struct OverlapClass {
  double least, below;
};

/** A seeded choice of pairs of the recordings, `count` of each class if there are so many, in the
 * order of the classes. Scans that lie longer apart than the odometry is good for do not pair. */
std::vector<RecordedPair> recordedPairs(const std::vector<std::string>& rawlogs,
                                        const std::vector<OverlapClass>& classes, size_t count,
                                        unsigned seed);

}  // namespace lamp
