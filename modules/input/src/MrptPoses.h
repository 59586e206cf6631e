#pragma once

#include <mrpt/poses/CPose2D.h>
#include <mrpt/poses/CPose3D.h>

#include "lamp/core/Geometry.h"

namespace lamp {

inline Pose3 poseFromMrpt(const mrpt::poses::CPose3D& pose) {
  Pose3 result = Pose3::Identity();
  const auto& R = pose.getRotationMatrix();
  for (int row = 0; row < 3; ++row) {
    for (int col = 0; col < 3; ++col) result.linear()(row, col) = R(row, col);
  }
  result.translation() = Eigen::Vector3d(pose.x(), pose.y(), pose.z());
  return result;
}

inline Pose3 poseFromMrpt(const mrpt::poses::CPose2D& pose) {
  return planarPose(pose.x(), pose.y(), pose.phi());
}

inline mrpt::poses::CPose3D poseToMrpt(const Pose3& pose) {
  return mrpt::poses::CPose3D::FromRotationAndTranslation(pose.rotation(),
                                                          Eigen::Vector3d(pose.translation()));
}

}  // namespace lamp
