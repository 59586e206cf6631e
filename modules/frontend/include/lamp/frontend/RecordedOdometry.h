#pragma once

#include <deque>
#include <memory>
#include <string>

#include "lamp/frontend/OdometrySource.h"
#include "lamp/input/OdometryFromObservation.h"

namespace lamp {

class OdometryContinuity;

/** Odometry that is in the recording: CObservationRobotPose, CObservationOdometry, odometry
 * actions, or a TUM file.
 *
 * A covariance on absolute poses is used where it grows from reading to reading; a constant one
 * says nothing about the motion and is ignored. Where odometry begins anew, it is continued; single
 * readings that are astray are left out.
 */
class RecordedOdometry : public OdometrySource {
  DEFINE_MRPT_OBJECT(RecordedOdometry, lamp)

 public:
  RecordedOdometry();
  void visit(OptionVisitor&) override {}
  void observe(const InputObservation& observation) override;
  bool covers(double stamp) const override;
  bool knows(double stamp) const override;
  Pose3 poseAt(double stamp) override;
  void keepFrom(double stamp) override;
  std::optional<Matrix6d> covarianceBetween(double begin, double end) override;
  Matrix6d doubtBetween(double begin, double end) const override;
  bool planar() const override { return planar_; }
  std::vector<std::string> warnings() const override;
  /** How much memory it takes, in readings. */
  size_t readingsHeld() const { return readings_.size(); }

 private:
  /** The reading at or after a stamp; the last one beyond the end. */
  std::deque<OdometryReading>::const_iterator atOrAfter(double stamp) const;
  void add(const OdometryReading& reading);
  void noteGap(const OdometryReading& before, const OdometryReading& after);
  bool staysInPlane(const OdometryReading& reading) const;
  std::vector<std::string> continuityWarnings() const;

  /** Time between two readings in which the robot has moved. */
  struct Gap {
    double begin = 0, end = 0;  ///< seconds, UTC
  };
  /** The reading at or after a stamp. */
  struct StampedReading {
    double stamp = 0;
    OdometryReading reading;
  };

  std::shared_ptr<OdometryContinuity> continuity_;
  std::optional<double> newest_;  ///< stamp, of what was observed
  std::optional<OdometryReading> first_;
  std::deque<OdometryReading> readings_;
  std::optional<StampedReading> kept_;
  std::deque<double> intervals_;  ///< seconds between the last readings
  std::vector<Gap> gaps_;
  double path_m_ = 0;
  bool planar_ = true;
  size_t ignored_covariances_ = 0;
  size_t out_of_order_ = 0;
  size_t not_finite_ = 0;
};

}  // namespace lamp
