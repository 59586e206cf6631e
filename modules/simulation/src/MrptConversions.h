#pragma once

#include <mrpt/core/Clock.h>
#include <mrpt/poses/CPose3D.h>

#include "lamp/core/Geometry.h"

namespace lamp::simulation {

inline mrpt::poses::CPose3D poseToMrpt(const Pose3& pose) {
  const Vector6d v = yawPitchRollFromPose(pose);
  return {v[0], v[1], v[2], v[3], v[4], v[5]};
}

inline mrpt::Clock::time_point stampToMrpt(double stamp) {
  return mrpt::Clock::fromDouble(stamp);
}

}  // namespace lamp::simulation
