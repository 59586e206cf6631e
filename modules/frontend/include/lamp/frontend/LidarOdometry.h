#pragma once

#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "lamp/core/KeyNodePacket.h"
#include "lamp/frontend/OdometrySource.h"
#include "lamp/frontend/PriorWeight.h"
#include "lamp/frontend/RelativeCovariance.h"
#include "lamp/scans/LocalMap.h"
#include "lamp/scans/RegistrationInformation.h"
#include "lamp/scans/ScanToMap.h"

namespace lamp {

struct LocatedScan;

struct LidarOdometryOptions {
  double min_matched_share = 0.3;
  double insert_distance_m = 0.5;
  double insert_angle_deg = 10.0;
  double max_acceleration_m_s2 = 4.0;
  double max_acceleration_rad_s2 = 4.0;
  double drift_m_per_m = 0.002;
  double drift_rad_per_m = 0.0002;
  RegistrationInformationOptions information;

  void visit(OptionVisitor& v);
};

/** Odometry from the lidar (paper II-B, after LOCUS 2.0): each scan is registered to a local map of
 * those before it, from where another odometry source, or where there is none the motion so far,
 * puts it. The other source is a prior, whose weight follows from its covariance and from how well
 * it has agreed with the lidar; directions that the surroundings leave free, as the axis of a
 * tunnel, take their motion from it, and the covariance says so. */
class LidarOdometry : public ScanOdometry {
  DEFINE_MRPT_OBJECT(LidarOdometry, lamp)

 public:
  LidarOdometryOptions options;

  LidarOdometry();
  ~LidarOdometry() override;

  void visit(OptionVisitor& v) override { options.visit(v); }
  void observe(const InputObservation&) override {}
  bool covers(double stamp) const override;
  bool knows(double stamp) const override;
  Pose3 poseAt(double stamp) override;
  void keepFrom(double stamp) override;
  std::optional<Matrix6d> covarianceBetween(double begin, double end) override;
  Matrix6d doubtBetween(double begin, double end) const override;
  bool planar() const override { return planar_; }
  std::vector<std::string> warnings() const override;

  Pose3 predictedMotion(double stamp) const override;
  Pose3 track(double stamp, const ScanMotion& known, FilteredScan& scan) override;
  std::optional<MeasuredRotation> seenOrientation() const override { return seen_; }

 private:
  /** A pose that a scan may have, and why. */
  struct Located {
    Pose3 odom_T_base = Pose3::Identity();
    Pose3 registered = Pose3::Identity();     ///< `odom_T_base` by the scan alone
    Matrix6d information = Matrix6d::Zero();  ///< from the scan alone, in the tangent space there
    MotionPrior prediction;
    double matched_share = 0;
    Innovation innovation;
    bool tracked = false;
    /** Corrected for the motion found; empty if the scan's own are right. */
    std::vector<Eigen::Vector3f> points;
  };

  void beginMap(const FilteredScan& scan, const Pose3& odom_T_base);
  MotionPrior constantVelocity(double seconds, const std::optional<MeasuredRotation>& turn) const;
  Located locate(const FilteredScan& scan, const MotionPrior& motion, bool anywhere,
                 const std::optional<Pose3>& nearby = {});
  Located locateBy(double stamp, const ScanMotion& known, const FilteredScan& scan);
  Located locateWithoutGyros(double stamp, const ScanMotion& known, const FilteredScan& scan);
  Located locateAlone(double stamp, const std::optional<MeasuredRotation>& turn,
                      const FilteredScan& scan, bool anywhere);
  Located settle(double stamp, const ScanMotion& known, const FilteredScan& scan,
                 const Located& by_prior);
  bool contradicts(const MeasuredRotation& turn, const Located& located) const;
  void addDoubt(const Vector6d& disagreement);
  void accept(double stamp, const FilteredScan& scan, const Located& located);
  void extendMap(const FilteredScan& scan, const Pose3& odom_T_base);

  bool planar_ = true;
  std::unique_ptr<LocatedScan> reference_;  ///< the last scan that was tracked
  std::unique_ptr<LocalMap> map_;           ///< none before a scan shows enough
  std::deque<StampedPose> poses_;           ///< of the last scans
  Pose3 last_motion_ = Pose3::Identity();
  double last_motion_s_ = 0;
  double travelled_m_ = 0;
  std::optional<Pose3> inserted_at_;
  RelativeCovariance covariance_;
  std::optional<StampedPose> kept_;
  double path_since_kept_m_ = 0;
  Matrix6d doubt_ = Matrix6d::Zero();  ///< since then, where two sources disagreed
  double usual_share_ = 0;             ///< of a scan that matches the map, mean of the last ones

  PriorWeight recorded_weight_;
  std::optional<MeasuredRotation> seen_;  ///< orientation by the last scan alone
  size_t lost_in_a_row_ = 0;
  int contradictions_in_a_row_ = 0;
  double lost_s_ = 0;  ///< for how long already
  size_t scans_ = 0, lost_ = 0, contradicted_ = 0;
  std::optional<double> first_lost_, first_contradicted_;  ///< stamps, seconds, UTC
};

}  // namespace lamp
