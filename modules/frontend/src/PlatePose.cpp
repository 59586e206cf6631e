#include "PlatePose.h"

#include <Eigen/Dense>

namespace lamp {

namespace {

using Eigen::Vector3d;
using Jacobian3 = Eigen::Matrix<double, 3, 6>;

constexpr int kIterations = 10;

/** Normal equations of the pose, in the tangent space at it. */
struct Normal {
  Matrix6d information = Matrix6d::Zero();
  Vector6d gradient = Vector6d::Zero();
  double chi_square = 0;

  template <class Jacobian, class Residual, class Weight>
  void add(const Jacobian& jacobian, const Residual& residual, const Weight& weight) {
    information += jacobian.transpose() * weight * jacobian;
    gradient += jacobian.transpose() * weight * residual;
    chi_square += residual.dot(weight * residual);
  }
};

Normal normalAt(const Pose3& world_T_base, const std::vector<PlateMiddle>& seen,
                const std::vector<Vector3d>& plates, const std::optional<FeltUp>& up) {
  const Eigen::Matrix3d R = world_T_base.linear();
  Normal normal;
  for (size_t i = 0; i < seen.size(); ++i) {
    Jacobian3 jacobian;
    jacobian << R, -R * skew(seen[i].position);
    const Vector3d residual = world_T_base * seen[i].position - plates[i];
    const Eigen::Matrix3d covariance = R * seen[i].covariance * R.transpose();
    normal.add(jacobian, residual, Eigen::Matrix3d(covariance.inverse()));
  }
  if (up) {
    Jacobian3 jacobian = Jacobian3::Zero();
    jacobian.rightCols<3>() = -R * skew(up->base_up);
    const Eigen::Vector2d residual = (R * up->base_up).head<2>();
    normal.add(jacobian.topRows<2>().eval(), residual,
               Eigen::Matrix2d(Eigen::Matrix2d::Identity() / (up->sigma_rad * up->sigma_rad)));
  }
  return normal;
}

}  // namespace

Pose3 poseOfPoints(const std::vector<Vector3d>& in_base, const std::vector<Vector3d>& in_world) {
  Eigen::Matrix3Xd from(3, in_base.size()), to(3, in_world.size());
  for (size_t i = 0; i < in_base.size(); ++i) {
    from.col(static_cast<Eigen::Index>(i)) = in_base[i];
    to.col(static_cast<Eigen::Index>(i)) = in_world[i];
  }
  return Pose3(Eigen::umeyama(from, to, false));
}

PlatePose poseOfPlates(const std::vector<PlateMiddle>& seen, const std::vector<Vector3d>& plates,
                       const std::optional<FeltUp>& up, const Pose3& guess) {
  PlatePose result;
  result.pose.world_T_base = guess;
  for (int i = 0; i < kIterations; ++i) {
    const Normal normal = normalAt(result.pose.world_T_base, seen, plates, up);
    const Vector6d step = -normal.information.ldlt().solve(normal.gradient);
    result.pose.world_T_base = normalized(result.pose.world_T_base * expSE3(step));
  }
  const Normal normal = normalAt(result.pose.world_T_base, seen, plates, up);
  result.pose.covariance = normal.information.inverse();
  result.chi_square = normal.chi_square;
  result.degrees_of_freedom = 3 * static_cast<int>(seen.size()) - 6 + (up ? 2 : 0);
  return result;
}

}  // namespace lamp
