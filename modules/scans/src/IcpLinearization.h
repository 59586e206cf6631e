#pragma once

#include <algorithm>
#include <cmath>

#include "lamp/core/Geometry.h"
#include "lamp/scans/Icp.h"

namespace lamp {

/** Normal equations of one Gauss-Newton step, for a motion about the pivot in the target's axes. */
struct IcpNormalEquations {
  Matrix6d H = Matrix6d::Zero();
  Vector6d g = Vector6d::Zero();  ///< half the cost's gradient
  double weights = 0;             ///< what the kernel leaves of the matches
  double squares = 0;             ///< weighted squared distances to the planes, metres²
  size_t matches = 0;

  /** Of the weighted distances to the planes, metres. */
  double rms() const { return std::sqrt(squares / std::max(weights, 1e-12)); }
};

/** Gauss-Newton step; in the plane only x, y and yaw move. Slight damping leaves directions that
 * the scans do not observe where they are. */
Vector6d solveStep(const IcpNormalEquations& equations, bool planar);

/** Moves the pose by a step about the pivot, in the target's axes. */
Pose3 movedAbout(const Eigen::Vector3d& pivot, const Vector6d& step, const Pose3& T);

/** Sums the normal equations over matched points. */
class Linearization {
 public:
  Linearization(IcpMetric metric, double plane_thickness, double kernel_m);

  /** \param lever from the pivot to the source point; \param r from the target to the source point;
   *  \param n target's normal; \param m source's normal, zero if unknown; all in the target's axes.
   */
  void add(const Eigen::Vector3d& lever, const Eigen::Vector3d& r, const Eigen::Vector3d& n,
           const Eigen::Vector3d& m);

  IcpNormalEquations result() const;

 private:
  double addPlaneToPlane(const Eigen::Vector3d& lever, const Eigen::Vector3d& r,
                         const Eigen::Vector3d& n, const Eigen::Vector3d& m);
  void addIsotropic(double weight, const Eigen::Vector3d& lever, const Eigen::Vector3d& r);

  const bool plane_to_plane_;
  const double thickness_, kernel_m_;
  IcpNormalEquations sum_;  ///< of the matrices, the upper triangles only
  double isotropic_ = 0;
  Eigen::Vector3d levers_ = Eigen::Vector3d::Zero();
  Eigen::Matrix3d lever_squares_ = Eigen::Matrix3d::Zero();
};

}  // namespace lamp
