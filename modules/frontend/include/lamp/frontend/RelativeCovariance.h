#pragma once

#include "lamp/core/Geometry.h"

namespace lamp {

/** Covariance of a robot's pose in its local map, and of its motion since a key node, as a filter
 * keeps them: motion adds to it, what the lidar sees takes from it. The pose at the key node stays
 * part of the state, so that a direction in which the robot has long drifted unseen and is then
 * pulled back is as uncertain as that pull. All in tangent spaces at the poses. */
class RelativeCovariance {
 public:
  /** The robot has moved. \param covariance of the motion, in the tangent space at it. */
  void predict(const Pose3& motion, const Matrix6d& covariance);
  /** Its pose was measured. \param information in the tangent space at the pose; may be singular.
   */
  void update(const Matrix6d& information);
  /** The motion from here on will be asked for. */
  void keep();

  /** Of the pose in the map. */
  const Matrix6d& pose() const { return pose_; }
  /** Of the motion since keep(). */
  Matrix6d sinceKept(const Pose3& motion) const;

 private:
  Matrix6d pose_ = Matrix6d::Zero();
  Matrix6d kept_ = Matrix6d::Zero();
  Matrix6d cross_ = Matrix6d::Zero();  ///< E[pose error · kept error transposed]
};

}  // namespace lamp
