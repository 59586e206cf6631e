#pragma once

#include "lamp/core/Geometry.h"

namespace lamp {

/** Poses in space, as the optimiser sees them: parameter blocks [x y z qx qy qz qw].
 *
 * Jacobians are taken with respect to right perturbations, `T · Exp(d)`, in tangent order
 * `[x y z, rx ry rz]`; null pointers ask for none. */
struct Se3 {
  static constexpr int kDof = 6;
  static constexpr int kSize = 7;
  using Pose = Pose3;
  using Tangent = Vector6d;
  using Jacobian = Matrix6d;

  static Pose fromPose3(const Pose3& T) { return T; }
  static Pose3 toPose3(const Pose& T) { return T; }
  static Pose load(const double* block);
  static void store(const Pose& T, double* block);
  /** The part of the information matrix that concerns this space. */
  static Jacobian information(const Matrix6d& m) { return m; }

  static Pose plus(const Pose& T, const Tangent& d);
  /** The d with `plus(from, d) = to`. */
  static Tangent minus(const Pose& to, const Pose& from);

  /** `Log(from_T_to⁻¹ · from⁻¹ · to)`. */
  static Tangent relativeError(const Pose& from_T_to, const Pose& from, const Pose& to,
                               Jacobian* d_from, Jacobian* d_to);
  /** `Log(measured⁻¹ · pose)`. */
  static Tangent priorError(const Pose& measured, const Pose& pose, Jacobian* d_pose);
};

/** Poses in the plane: parameter blocks [x y yaw], perturbed by [x y] in the robot's frame and yaw.
 *
 * Errors are translation and wrapped yaw of `from_T_to⁻¹ · from⁻¹ · to`: to first order what
 * logSE3() gives in kPlanarAxes, and cheaper. */
struct Se2 {
  static constexpr int kDof = 3;
  static constexpr int kSize = 3;
  using Pose = Eigen::Vector3d;
  using Tangent = Eigen::Vector3d;
  using Jacobian = Eigen::Matrix3d;

  static Pose fromPose3(const Pose3& T);
  static Pose3 toPose3(const Pose& p) { return planarPose(p.x(), p.y(), p.z()); }
  static Pose load(const double* block) { return Eigen::Map<const Pose>(block); }
  static void store(const Pose& p, double* block) {
    Eigen::Map<Pose> stored(block);
    stored = p;
  }
  static Jacobian information(const Matrix6d& m);

  static Pose plus(const Pose& p, const Tangent& d);
  static Tangent minus(const Pose& to, const Pose& from);

  static Tangent relativeError(const Pose& from_T_to, const Pose& from, const Pose& to,
                               Jacobian* d_from, Jacobian* d_to);
  static Tangent priorError(const Pose& measured, const Pose& pose, Jacobian* d_pose);
};

}  // namespace lamp
