#pragma once

#include "lamp/core/Geometry.h"

namespace lamp {

/** A point that depends on a pose. */
template <int kDof>
struct PosedPoint {
  Eigen::Vector3d p;
  Eigen::Matrix<double, 3, kDof> d_pose;
};

/** Poses in space, as the optimiser sees them: parameter blocks [x y z qx qy qz qw].
 *
 * Jacobians are taken with respect to right perturbations, `T · Exp(d)`, in tangent order
 * `[x y z, rx ry rz]`; null pointers ask for none. */
struct Se3 {
  static constexpr int kDof = 6;
  static constexpr int kSize = 7;
  /** How many of the tangent's coordinates move the position; they come first. */
  static constexpr int kPositionDof = 3;
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
  /** The two components of the rotation error at right angles to gravity, in the rotation's
   * coordinates. */
  static Tangent gravityError(const Pose& measured, const Pose& pose, Jacobian* d_pose);

  /** `T · local`. */
  static PosedPoint<kDof> toWorld(const Pose& T, const Eigen::Vector3d& local);
  /** `T⁻¹ · world`. */
  static PosedPoint<kDof> toLocal(const Pose& T, const Eigen::Vector3d& world);
  static Eigen::Vector3d position(const Pose& T) { return T.translation(); }
  static Eigen::Matrix3d rotation(const Pose& T) { return T.linear(); }
  /** Projects tangents onto the directions about which gravity says nothing. */
  static Jacobian positionAndYaw(const Pose& T);
};

/** A pose in the plane. Sine and cosine of the yaw are stored: they cost more than all the rest. */
struct Pose2 {
  Pose2() = default;
  Pose2(double x, double y, double yaw_rad);
  Pose2(double x, double y, double yaw_rad, double cos_yaw, double sin_yaw)
      : position(x, y), yaw(yaw_rad), cosine(cos_yaw), sine(sin_yaw) {}

  Eigen::Matrix2d rotation() const;

  Eigen::Vector2d position = Eigen::Vector2d::Zero();
  double yaw = 0, cosine = 1, sine = 0;
};

/** Poses in the plane: parameter blocks [x y yaw], perturbed by [x y] in the robot's frame and yaw.
 *
 * Errors are translation and wrapped yaw of `from_T_to⁻¹ · from⁻¹ · to`: to first order what
 * logSE3() gives in kPlanarAxes, and cheaper. */
struct Se2 {
  static constexpr int kDof = 3;
  static constexpr int kSize = 3;
  static constexpr int kPositionDof = 2;
  using Pose = Pose2;
  using Tangent = Eigen::Vector3d;
  using Jacobian = Eigen::Matrix3d;

  static Pose fromPose3(const Pose3& T);
  static Pose3 toPose3(const Pose& p) { return planarPose(p.position.x(), p.position.y(), p.yaw); }
  static Pose load(const double* block) { return {block[0], block[1], block[2]}; }
  static void store(const Pose& p, double* block);
  static Jacobian information(const Matrix6d& m);

  static Pose plus(const Pose& p, const Tangent& d);
  static Tangent minus(const Pose& to, const Pose& from);

  static Tangent relativeError(const Pose& from_T_to, const Pose& from, const Pose& to,
                               Jacobian* d_from, Jacobian* d_to);
  static Tangent priorError(const Pose& measured, const Pose& pose, Jacobian* d_pose);
  /** Zero: a planar robot stands level. */
  static Tangent gravityError(const Pose& measured, const Pose& pose, Jacobian* d_pose);

  static PosedPoint<kDof> toWorld(const Pose& p, const Eigen::Vector3d& local);
  static PosedPoint<kDof> toLocal(const Pose& p, const Eigen::Vector3d& world);
  static Eigen::Vector3d position(const Pose& p) { return {p.position.x(), p.position.y(), 0.0}; }
  static Eigen::Matrix3d rotation(const Pose& p);
  static Jacobian positionAndYaw(const Pose&) { return Jacobian::Identity(); }
};

}  // namespace lamp
