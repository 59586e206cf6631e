#pragma once

#include <gtest/gtest.h>

#include <functional>
#include <random>
#include <string>

#include "TemporaryFolder.h"
#include "lamp/core/Geometry.h"

namespace lamp::test {

/** What the call throws, or an empty string. */
inline std::string thrownBy(const std::function<void()>& call) {
  try {
    call();
  } catch (const std::exception& error) {
    return error.what();
  }
  return "";
}

/** Poses and matrices from a fixed seed. */
class Random {
 public:
  double uniform(double min, double max) {
    return std::uniform_real_distribution<double>(min, max)(engine_);
  }
  Eigen::Vector3d direction() {
    Eigen::Vector3d v;
    do v << uniform(-1, 1), uniform(-1, 1), uniform(-1, 1);
    while (v.norm() < 0.1);
    return v.normalized();
  }
  Vector6d tangent(double max_translation, double angle) {
    Vector6d d;
    d << max_translation * uniform(0, 1) * direction(), angle * direction();
    return d;
  }
  Pose3 pose() { return expSE3(tangent(10, uniform(0, 3))); }
  /** Away from the pitch of 90 degrees, where yaw and roll are not distinct. */
  Pose3 uprightPose() {
    Vector6d v;
    v << uniform(-9, 9), uniform(-9, 9), uniform(-9, 9), uniform(-3, 3), uniform(-1.2, 1.2),
        uniform(-3, 3);
    return poseFromYawPitchRoll(v);
  }
  /** Symmetric and positive definite, with coupling between all axes. */
  Matrix6d covariance() {
    Matrix6d m;
    for (int i = 0; i < 36; ++i) m(i / 6, i % 6) = uniform(-1, 1);
    return m * m.transpose() + 0.1 * Matrix6d::Identity();
  }

 private:
  std::mt19937 engine_{20240607};
};

/** Central differences of a function of a 6-vector at zero. */
inline Matrix6d numericalJacobian(const std::function<Vector6d(const Vector6d&)>& f,
                                  double step = 1e-5) {
  Matrix6d J;
  for (int i = 0; i < 6; ++i) {
    const Vector6d d = step * Vector6d::Unit(i);
    J.col(i) = (f(d) - f(-d)) / (2 * step);
  }
  return J;
}

inline double distance(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  return (a - b).cwiseAbs().maxCoeff();
}

}  // namespace lamp::test
