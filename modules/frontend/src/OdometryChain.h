#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "GyroRotation.h"
#include "OdometryComparison.h"
#include "lamp/frontend/MotionModel.h"
#include "lamp/frontend/OdometrySource.h"

namespace lamp {

/** The odometry sources of one robot, as one: scan odometry with the others as its prior, or where
 * there is none the first of the others that has anything to say.
 *
 * Keyed scans lie far apart, and whoever keyed them had odometry at full rate: scan odometry is
 * used for them only if the recording has no other. */
class OdometryChain {
 public:
  /** \param sources in order of preference. */
  OdometryChain(std::vector<std::shared_ptr<OdometrySource>> sources, bool keyed,
                const MotionModelOptions& motion);

  void observe(const InputObservation& observation);
  /** Whether a scan that ends at `stamp` can be processed: all is known of its motion that will be.
   */
  bool ready(double stamp);
  /** No more observations will come. */
  void finish();
  /** Whether scans are tracked, see track(). To be asked when ready(). */
  bool tracks() const { return tracks_.value_or(false); }

  /** The next scan goes to scan odometry, if tracks(). \return `odom_T_base`. */
  Pose3 track(double stamp, FilteredScan& scan);
  /** `from_T_to`, for moments within and between the last scans: as recorded, where that is known,
   * else as the robot has moved last; turned as gyros say, if there are any. */
  Pose3 motion(double from, double to) const;
  Pose3 poseAt(double stamp) const { return main().poseAt(stamp); }
  bool knows(double stamp) const { return main().knows(stamp); }
  bool covers(double stamp) const { return main().covers(stamp); }
  void keepFrom(double stamp) { main().keepFrom(stamp); }
  /** See OdometrySource. */
  std::optional<Matrix6d> covarianceBetween(double begin, double end) const {
    return main().covarianceBetween(begin, end);
  }
  Matrix6d doubtBetween(double begin, double end) const { return main().doubtBetween(begin, end); }
  /** Whether the robot has stayed in the plane, as far as anything but its scans tells. */
  bool planar() const;
  /** Dead reckoning of another source at a scan's stamp, if one knows. */
  std::optional<Pose3> recordedPose(double stamp) const;
  /** For what is not made of scans: observations at any stamp. */
  OdometrySource& main() const;
  std::vector<std::string> warnings() const;

 private:
  OdometrySource* recorded() const;
  bool recordedKnows(double from, double to) const;
  Pose3 motionWithoutGyros(double from, double to) const;
  std::optional<MeasuredRotation> turn(double from, double to) const;
  std::optional<MotionPrior> prior(double from, double to) const;
  Matrix6d stampCovariance(double from, double to, const Pose3& motion) const;

  std::shared_ptr<ScanOdometry> tracker_;
  std::vector<std::shared_ptr<OdometrySource>> others_;
  const bool keyed_;
  const MotionModelOptions motion_;
  GyroRotation gyros_;
  double stamp_sigma_s_ = 0;  ///< how well stamps of scans and of odometry agree
  bool planar_ = false;       ///< the last scan tracked
  std::optional<bool> tracks_;
  double newest_ = 0;           ///< stamp, of all scans: other clocks may differ
  std::optional<double> last_;  ///< stamp of the last scan tracked
  OdometryComparison comparison_;
};

}  // namespace lamp
