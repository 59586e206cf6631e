#pragma once

#include <deque>
#include <string>

#include "lamp/frontend/OdometrySource.h"
#include "lamp/input/OdometryFromObservation.h"

namespace lamp {

/** Odometry that is in the recording: CObservationRobotPose, CObservationOdometry, odometry
 * actions, or a TUM file.
 *
 * A covariance on absolute poses is used where it grows from reading to reading; a constant one
 * says nothing about the motion and is ignored.
 */
class RecordedOdometry : public OdometrySource {
  DEFINE_MRPT_OBJECT(RecordedOdometry, lamp)

 public:
  void visit(OptionVisitor&) override {}
  void observe(const InputObservation& observation) override;
  bool covers(double stamp) const override;
  Pose3 poseAt(double stamp) override;
  std::optional<Matrix6d> covarianceBetween(double begin, double end) override;
  bool planar() const override { return planar_; }
  std::vector<std::string> warnings() const override;

 private:
  /** The reading at or after a stamp; the last one beyond the end. */
  std::deque<OdometryReading>::const_iterator atOrAfter(double stamp) const;
  void forgetBefore(double stamp);

  std::deque<OdometryReading> readings_;
  bool planar_ = true;
  size_t ignored_covariances_ = 0;
  size_t out_of_order_ = 0;
  size_t not_finite_ = 0;
};

}  // namespace lamp
