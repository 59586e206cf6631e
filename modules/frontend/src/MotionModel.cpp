#include "lamp/frontend/MotionModel.h"

#include <cmath>

namespace lamp {

void MotionModelOptions::visit(OptionVisitor& v) {
  v("sigma_m_per_m", sigma_m_per_m, "m/m", "odometry's position error per metre travelled",
    kNotNegative);
  v("sigma_rad_per_m", sigma_rad_per_m, "rad/m", "odometry's rotation error per metre travelled",
    kNotNegative);
  v("sigma_rad_per_rad", sigma_rad_per_rad, "rad/rad",
    "odometry's rotation error per radian turned", kNotNegative);
  v("min_sigma_m", min_sigma_m, "m", "lower bound on the position error of an odometry edge",
    kPositive);
  v("min_sigma_rad", min_sigma_rad, "rad", "lower bound on the rotation error of an odometry edge",
    kPositive);
}

void Path::add(const Pose3& motion) {
  length_m += motion.translation().norm();
  turned_rad += rotationAngle(motion);
}

Matrix6d odometryCovariance(const Path& path, const MotionModelOptions& options) {
  const double sigma_m = std::hypot(options.min_sigma_m, options.sigma_m_per_m * path.length_m);
  const double sigma_rad =
      std::hypot(options.min_sigma_rad, options.sigma_rad_per_m * path.length_m,
                 options.sigma_rad_per_rad * path.turned_rad);
  Vector6d variances;
  variances.head<3>().setConstant(sigma_m * sigma_m);
  variances.tail<3>().setConstant(sigma_rad * sigma_rad);
  return variances.asDiagonal();
}

Matrix6d stepCovariance(const Pose3& motion, const MotionModelOptions& options) {
  constexpr double kEdgeM = 2.0, kEdgeRad = 0.5;
  constexpr double kLeastM = 0.001, kLeastRad = 0.0004;
  const double length = motion.translation().norm(), turned = rotationAngle(motion);
  const double share = length / kEdgeM + turned / kEdgeRad;
  const double sigma_m = options.sigma_m_per_m * std::sqrt(kEdgeM * length);
  const double sigma_rad = std::hypot(options.sigma_rad_per_m * std::sqrt(kEdgeM * length),
                                      options.sigma_rad_per_rad * std::sqrt(kEdgeRad * turned));
  const auto variance = [&](double sigma, double min_sigma, double least) {
    return sigma * sigma + share * min_sigma * min_sigma + least * least;
  };
  Vector6d variances;
  variances.head<3>().setConstant(variance(sigma_m, options.min_sigma_m, kLeastM));
  variances.tail<3>().setConstant(variance(sigma_rad, options.min_sigma_rad, kLeastRad));
  return variances.asDiagonal();
}

}  // namespace lamp
