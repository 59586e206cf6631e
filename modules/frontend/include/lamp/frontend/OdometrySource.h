#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "lamp/core/Geometry.h"
#include "lamp/core/Stage.h"
#include "lamp/input/ObservationSource.h"

namespace lamp {

/** Dead reckoning of one robot, from whatever it carries (paper II-B). One instance a robot. */
class OdometrySource : public Stage {
  DEFINE_VIRTUAL_MRPT_OBJECT(OdometrySource)

 public:
  /** Takes any observation of the robot; those it has no use for are ignored. */
  virtual void observe(const InputObservation& observation) = 0;
  /** True once poses up to `stamp` (seconds, UTC) are final. */
  virtual bool covers(double stamp) const = 0;
  /** False where the readings around a stamp that is covered are too far apart, in time and in
   * motion, to tell where the robot was between them, and before the first one. */
  virtual bool knows(double stamp) const = 0;
  /** `odom_T_base`, interpolated between the neighbouring readings and held beyond the ends. To be
   * asked for within a minute: older readings may be forgotten. */
  virtual Pose3 poseAt(double stamp) = 0;
  /** The motion from this stamp on will be asked for, however long it lasts. */
  virtual void keepFrom(double stamp) = 0;
  /** Covariance of the motion between two stamps, in the tangent space at that motion; none if the
   * source does not know it. To be asked before later poses. */
  virtual std::optional<Matrix6d> covarianceBetween(double begin, double end) = 0;
  /** Covariance that a motion between two stamps has beside, for motion that was not measured: zero
   * unless odometry began anew between them. To be asked before later poses. */
  virtual Matrix6d doubtBetween(double begin, double end) const = 0;
  /** True as long as the robot has moved in the plane of its first pose only. */
  virtual bool planar() const = 0;
  /** What a user should know, in words. */
  virtual std::vector<std::string> warnings() const = 0;
};

/** What another source says of the motion between two scans. */
struct MotionPrior {
  Pose3 motion = Pose3::Identity();
  Matrix6d covariance = Matrix6d::Identity();  ///< in the tangent space at the motion
};

/** A rotation, as gyros or a scan tell it. */
struct MeasuredRotation {
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  double sigma_rad = 0;  ///< about each axis
};

/** What is known of the motion between two scans without them. */
struct ScanMotion {
  std::optional<MotionPrior> recorded;   ///< from another source of odometry
  std::optional<MeasuredRotation> turn;  ///< from gyros, measured during the scan as well
};

/** A scan as odometry needs it. */
struct FilteredScan {
  std::vector<Eigen::Vector3f> points;  ///< base frame at the scan's stamp, metres
  /** When each point was measured, seconds since the stamp; empty if nobody knows. */
  std::vector<float> time;
  /** The motion by which points were brought from the base frame at their time to that at the
   * stamp, a second: `Exp(time · twist)`. */
  Vector6d twist = Vector6d::Zero();
  Eigen::Vector3f origin = Eigen::Vector3f::Zero();  ///< of the first lidar
  bool planar = false;  ///< of a level 2D laser on a robot that stays level
};

/** Odometry that is made of the robot's scans, with the other sources of its list as a prior. */
class ScanOdometry : public OdometrySource {
  DEFINE_VIRTUAL_MRPT_OBJECT(ScanOdometry)

 public:
  /** The motion from the last scan to `stamp` (seconds, UTC) if the robot goes on as it did. */
  virtual Pose3 predictedMotion(double stamp) const = 0;
  /** The next scan. \param known of the motion since the last one.
   * \param[in,out] scan where no other source knew how the robot moved while the lidar turned, its
   * points are put where the motion that is found wants them. \return `odom_T_base` at the scan's
   * stamp, as poseAt() will. */
  virtual Pose3 track(double stamp, const ScanMotion& known, FilteredScan& scan) = 0;
  /** `odom_R_base` by the last scan alone; none if it does not tell. */
  virtual std::optional<MeasuredRotation> seenOrientation() const = 0;
};

/** Registers LidarOdometry and RecordedOdometry. */
void registerAllClasses_lamp_frontend();

}  // namespace lamp
