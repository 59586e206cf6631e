#include "solver/PointErrors.h"

#include <cmath>

namespace lamp {

namespace {

/** angle / sin(angle), and its derivative with respect to cos(angle). */
struct SphereLog {
  explicit SphereLog(double cosine, double sine) {
    // Beyond a right angle the derivative grows without bound; no measurement is that wrong.
    constexpr double kSmallSine = 1e-4;
    if (sine < kSmallSine && cosine > 0) {
      factor = 1.0 + sine * sine / 6.0;
      derivative = -1.0 / 3.0;
      return;
    }
    const double safe_sine = std::max(sine, kSmallSine);
    const double angle = std::atan2(safe_sine, cosine);
    factor = angle / safe_sine;
    derivative = (factor * cosine - 1.0) / (safe_sine * safe_sine);
  }

  double factor, derivative;
};

}  // namespace

Eigen::Vector3d gravityError(const Eigen::Matrix3d& measured_world_R_base,
                             const Eigen::Matrix3d& world_R_base, Eigen::Matrix3d* d_rotation) {
  const Eigen::Vector3d measured_up = measured_world_R_base.row(2), up = world_R_base.row(2);
  const Eigen::Vector3d axis = up.cross(measured_up);
  const SphereLog log(up.dot(measured_up), axis.norm());
  if (d_rotation) {
    const Eigen::Matrix3d d_up = skew(up);  // up of R · Exp(d) is up + up x d
    *d_rotation = -log.factor * skew(measured_up) * d_up +
                  log.derivative * axis * (measured_up.transpose() * d_up);
  }
  return log.factor * axis;
}

Eigen::Vector3d bearingRangeError(const Eigen::Vector3d& measured, const Eigen::Vector3d& estimated,
                                  Eigen::Matrix3d* d_estimated) {
  constexpr double kSmallDistance = 1e-9;
  const double range = measured.norm(), distance = std::max(estimated.norm(), kSmallDistance);
  const Eigen::Vector3d u = measured / range, w = estimated / distance;
  const double cosine = u.dot(w);
  const Eigen::Vector3d across = w - cosine * u;
  const SphereLog log(cosine, across.norm());
  if (d_estimated) {
    const Eigen::Matrix3d across_u = Eigen::Matrix3d::Identity() - u * u.transpose();
    const Eigen::Matrix3d d_w = (Eigen::Matrix3d::Identity() - w * w.transpose()) / distance;
    const Eigen::Matrix3d d_arc = log.factor * across_u + log.derivative * across * u.transpose();
    *d_estimated = u * w.transpose() + range * d_arc * d_w;
  }
  return (distance - range) * u + range * log.factor * across;
}

double rangeError(double measured_m, const Eigen::Vector3d& between,
                  Eigen::RowVector3d* d_between) {
  constexpr double kSmallDistance = 1e-9;
  const double distance = between.norm();
  if (d_between)
    *d_between = distance > kSmallDistance ? Eigen::RowVector3d(between.transpose() / distance)
                                           : Eigen::RowVector3d::UnitX();
  return distance - measured_m;
}

}  // namespace lamp
