#pragma once

#include <functional>
#include <vector>

#include "lamp/core/Geometry.h"

namespace lamp::simulation {

/** A sensor's pose during a sweep. Poses of a few times are exact, those between are linear in
 * translation and quaternion, which is good to micrometres over the 3 ms between and costs a
 * fraction of an exponential map per firing. */
class SensorPath {
 public:
  /** \param poseAt pose of the sensor at a stamp, in any one frame. */
  SensorPath(const std::function<Pose3(double)>& poseAt, double begin, double duration);
  /** \param delay seconds since the begin, within the duration. */
  Eigen::Isometry3f at(double delay) const;

 private:
  struct Support {
    Eigen::Quaterniond rotation;
    Eigen::Vector3d position;
  };
  double spacing_;
  std::vector<Support> supports_;
};

}  // namespace lamp::simulation
