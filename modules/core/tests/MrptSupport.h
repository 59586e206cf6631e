#pragma once

#include <mrpt/poses/CPose3D.h>

#include <Eigen/Core>

namespace lamp::test {

inline Eigen::Matrix4d matrixOf(const mrpt::poses::CPose3D& pose) {
  return pose.getHomogeneousMatrixVal<mrpt::math::CMatrixDouble44>().asEigen();
}

}  // namespace lamp::test
