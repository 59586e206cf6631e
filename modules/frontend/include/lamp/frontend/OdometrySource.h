#pragma once

#include <optional>
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
  /** `odom_T_base`, interpolated between the neighbouring readings and held beyond the ends.
   * Readings older than the last stamp asked for may be forgotten. */
  virtual Pose3 poseAt(double stamp) = 0;
  /** Covariance of the motion between two stamps, in the tangent space at that motion; none if the
   * source does not know it. To be asked before later poses. */
  virtual std::optional<Matrix6d> covarianceBetween(double begin, double end) = 0;
  /** True if the robot's motion is known in the plane only. */
  virtual bool planar() const = 0;
  /** What a user should know, in words. */
  virtual std::vector<std::string> warnings() const = 0;
};

/** Registers RecordedOdometry. */
void registerAllClasses_lamp_frontend();

}  // namespace lamp
