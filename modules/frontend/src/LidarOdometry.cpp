#include "lamp/frontend/LidarOdometry.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "GyroRotation.h"
#include "MapLeaf.h"
#include "MapSearch.h"
#include "Undistortion.h"
#include "lamp/core/Csv.h"

IMPLEMENTS_VIRTUAL_MRPT_OBJECT(ScanOdometry, lamp::OdometrySource, lamp)
IMPLEMENTS_MRPT_OBJECT(LidarOdometry, lamp::ScanOdometry, lamp)

namespace lamp {

namespace {

constexpr double kDegree = M_PI / 180.0;

/** Poses so long before the newest are not asked for any more. */
constexpr double kKeptS = 60.0;
/** A stamp so near a scan has the scan's pose, about. */
constexpr double kNearS = 0.5;

/** What was last seen so far back is forgotten: by then odometry may have drifted by more than what
 * a scan can be registered from. */
constexpr double kRememberedM = 100.0;
/** The map reaches this many times as far as the scan. */
constexpr double kReach = 1.5;

/** What a scan and the local map have in common of the patches' deviation. */
constexpr double kCommonShareInMap = 0.1;

/** A robot whose speed nobody knows. */
constexpr double kSpeedM = 2.0, kSpeedRad = 1.0;
constexpr double kStillM = 0.005, kStillRad = 0.1 * kDegree;

/** Nothing is known better. */
constexpr double kLeastM = 0.001, kLeastRad = 0.02 * kDegree;

/** A prediction whose error is this much larger than it should be, on average over the degrees of
 * freedom, is wrong. */
constexpr double kWrongSurprise = 16.0;
/** A point may lie so many standard deviations of the prediction off. */
constexpr double kSigmas = 3.0;
/** Scans in a row that contradict another source before the lidar is believed: a scan taken in a
 * fast turn may err, and nothing is lost, as the next one is registered to the map, too. */
constexpr int kBelieved = 3;
/** A scan that matches so much need not be sought elsewhere, if that is this part of what scans
 * usually do. One that fits better without the other source comes nearer to that. */
constexpr double kGoodShare = 0.5, kGoodPart = 0.8, kUsualPart = 0.9;
constexpr double kShareMemory = 0.05;
/** After so many scans that match nothing the map is begun anew. */
constexpr size_t kLostForGood = 10;
/** A map begins with a scan of so many points. */
constexpr size_t kFewestPoints = 50;

float radiusOf(const std::vector<Eigen::Vector3f>& points) {
  double sum = 0;
  for (const Eigen::Vector3f& point : points) sum += point.cast<double>().squaredNorm();
  return static_cast<float>(
      std::sqrt(sum / std::max<double>(1, static_cast<double>(points.size()))));
}

float farthest(const std::vector<Eigen::Vector3f>& points) {
  float most = 0;
  for (const Eigen::Vector3f& point : points) most = std::max(most, point.squaredNorm());
  return std::sqrt(most);
}

/** The scan as another motion during its sweep makes it. */
FilteredScan undistortedBy(const Vector6d& twist, FilteredScan scan) {
  const auto correction = [&](double time) {
    return Pose3(expSE3(time * twist) * expSE3(time * scan.twist).inverse());
  };
  undistort(scan.time, correction, scan.points);
  scan.twist = twist;
  return scan;
}

/** Whether a motion is not what a prior says. */
bool differs(const Pose3& motion, const MotionPrior& prior) {
  return Innovation{logSE3(prior.motion.inverse() * motion), prior.covariance.inverse()}
             .surprise() > kWrongSurprise;
}

/** None if the surfaces do not hold all its axes. */
std::optional<MeasuredRotation> orientationBy(const Pose3& registered,
                                              const Matrix6d& information) {
  const Eigen::Matrix3d rotations = information.bottomRightCorner<3, 3>();
  const double least =
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(rotations, Eigen::EigenvaluesOnly)
          .eigenvalues()[0];
  if (!(least > 0)) return std::nullopt;
  return MeasuredRotation{registered.linear(), 1 / std::sqrt(least)};
}

/** The same motion with another rotation. */
void turnBy(const MeasuredRotation& turn, MotionPrior& prior) {
  prior.motion.linear() = turn.rotation;
  prior.covariance.topRightCorner<3, 3>().setZero();
  prior.covariance.bottomLeftCorner<3, 3>().setZero();
  prior.covariance.bottomRightCorner<3, 3>() =
      turn.sigma_rad * turn.sigma_rad * Eigen::Matrix3d::Identity();
}

/** Without what lies out of the plane: nothing moves there, and nothing is measured. */
Matrix6d inPlane(const Matrix6d& m) {
  Matrix6d result = Matrix6d::Zero();
  for (const int a : kPlanarAxes)
    for (const int b : kPlanarAxes) result(a, b) = m(a, b);
  return result;
}

Matrix6d diagonal(double sigma_m, double sigma_rad) {
  Vector6d variances;
  variances.head<3>().setConstant(sigma_m * sigma_m);
  variances.tail<3>().setConstant(sigma_rad * sigma_rad);
  return variances.asDiagonal();
}

}  // namespace

LidarOdometry::LidarOdometry() = default;
LidarOdometry::~LidarOdometry() = default;

void LidarOdometryOptions::visit(OptionVisitor& v) {
  v("min_matched_share", min_matched_share, "",
    "a scan of which a smaller fraction lies on surfaces of the local map is not registered to it",
    kShare);
  v("insert_distance_m", insert_distance_m, "m",
    "distance travelled before a scan is added to the local map; smaller values follow the "
    "surroundings more closely, larger ones drift less",
    kPositive);
  v("insert_angle_deg", insert_angle_deg, "deg", "rotation before a scan is added to the local map",
    kPositive);
  v("max_acceleration_m_s2", max_acceleration_m_s2, "m/s2",
    "how much a robot may speed up or slow down: where no other source predicts its motion, it is "
    "taken to go on as it did, to this",
    kPositive);
  v("max_acceleration_rad_s2", max_acceleration_rad_s2, "rad/s2", "the same for turning",
    kPositive);
  v("drift_m_per_m", drift_m_per_m, "m/m",
    "position error that the local map adds per metre travelled", kNotNegative);
  v("drift_rad_per_m", drift_rad_per_m, "rad/m",
    "rotation error that the local map adds per metre travelled", kNotNegative);
  information.visit(v);
}

bool LidarOdometry::covers(double stamp) const {
  return !poses_.empty() && poses_.back().stamp >= stamp;
}

bool LidarOdometry::knows(double stamp) const {
  return !poses_.empty() && stamp >= poses_.front().stamp - kNearS;
}

Pose3 LidarOdometry::poseAt(double stamp) {
  if (poses_.empty()) return Pose3::Identity();
  const auto after =
      std::lower_bound(poses_.begin(), poses_.end(), stamp,
                       [](const StampedPose& pose, double t) { return pose.stamp < t; });
  if (after == poses_.begin()) return after->pose;
  if (after == poses_.end())
    return poses_.back().pose * predictedMotion(std::min(stamp, poses_.back().stamp + kNearS));
  const auto before = after - 1;
  return interpolate(before->pose, after->pose,
                     (stamp - before->stamp) / (after->stamp - before->stamp));
}

void LidarOdometry::keepFrom(double stamp) {
  kept_ = StampedPose{stamp, poseAt(stamp)};
  path_since_kept_m_ = 0;
  doubt_.setZero();
  covariance_.keep();
}

std::optional<Matrix6d> LidarOdometry::covarianceBetween(double begin, double end) {
  if (!kept_ || kept_->stamp != begin || poses_.empty() || poses_.back().stamp != end)
    return std::nullopt;
  const Pose3 motion = kept_->pose.inverse() * poses_.back().pose;
  return covariance_.sinceKept(motion) +
         diagonal(kLeastM + options.drift_m_per_m * path_since_kept_m_,
                  kLeastRad + options.drift_rad_per_m * path_since_kept_m_);
}

Matrix6d LidarOdometry::doubtBetween(double begin, double) const {
  return kept_ && kept_->stamp == begin ? doubt_ : Matrix6d::Zero();
}

Pose3 LidarOdometry::predictedMotion(double stamp) const {
  if (poses_.empty() || !(last_motion_s_ > 0)) return Pose3::Identity();
  return interpolate(Pose3::Identity(), last_motion_,
                     (stamp - poses_.back().stamp) / last_motion_s_);
}

MotionPrior LidarOdometry::constantVelocity(double seconds,
                                            const std::optional<MeasuredRotation>& turn) const {
  MotionPrior prior;
  prior.motion = predictedMotion(poses_.back().stamp + seconds);
  if (!(last_motion_s_ > 0)) {
    prior.covariance = diagonal(kSpeedM * seconds, kSpeedRad * seconds);
  } else {
    const double span = seconds * (0.5 * (seconds + last_motion_s_) + lost_s_);
    prior.covariance = diagonal(kStillM + options.max_acceleration_m_s2 * span,
                                kStillRad + options.max_acceleration_rad_s2 * span);
  }
  if (turn) turnBy(*turn, prior);
  return prior;
}

Pose3 LidarOdometry::track(double stamp, const ScanMotion& known, FilteredScan& scan) {
  ++scans_;
  if (poses_.empty()) {
    planar_ = scan.planar;
    poses_.push_back({stamp, Pose3::Identity()});
    beginMap(scan, Pose3::Identity());
    return Pose3::Identity();
  }
  Located best = locateBy(stamp, known, scan);
  if (known.turn && (!best.tracked || contradicts(*known.turn, best))) {
    const Located without = locateWithoutGyros(stamp, known, scan);
    if (without.tracked && without.matched_share >= best.matched_share) best = without;
  }
  seen_.reset();
  if (best.tracked) seen_ = orientationBy(best.registered, best.information);
  if (!best.points.empty()) scan.points = std::move(best.points);
  accept(stamp, scan, best);
  return poses_.back().pose;
}

/** Whether gyros contradict what the last two scans say alone. */
bool LidarOdometry::contradicts(const MeasuredRotation& turn, const Located& located) const {
  const auto seen = orientationBy(located.registered, located.information);
  if (!seen || !seen_) return false;
  return contradict(turn, {seen_->rotation.transpose() * seen->rotation,
                           std::hypot(seen_->sigma_rad, seen->sigma_rad)});
}

LidarOdometry::Located LidarOdometry::locateWithoutGyros(double stamp, const ScanMotion& known,
                                                         const FilteredScan& scan) {
  if (known.recorded) return locate(scan, recorded_weight_.weighed(*known.recorded), false);
  return locateAlone(stamp, std::nullopt, scan, true);
}

LidarOdometry::Located LidarOdometry::locateBy(double stamp, const ScanMotion& known,
                                               const FilteredScan& scan) {
  if (!known.recorded) return locateAlone(stamp, known.turn, scan, true);
  MotionPrior prior = recorded_weight_.weighed(*known.recorded);
  const double variance = prior.covariance.diagonal().tail<3>().maxCoeff();
  if (known.turn && std::pow(known.turn->sigma_rad, 2) < variance) turnBy(*known.turn, prior);
  Located best = locate(scan, prior, false);
  if (best.tracked) recorded_weight_.judge(best.innovation);
  if (!best.tracked || best.innovation.surprise() > kWrongSurprise)
    return settle(stamp, known, scan, best);
  contradictions_in_a_row_ = 0;
  return best;
}

/** The lidar seems to contradict the other source, or matches nothing from where that puts it.
 * Where the robot would be without that source tells which of the two to believe. \param by_prior
 * located from the other source's motion. */
LidarOdometry::Located LidarOdometry::settle(double stamp, const ScanMotion& known,
                                             const FilteredScan& scan, const Located& by_prior) {
  Located alone = locateAlone(stamp, known.turn, scan, false);
  const bool fits = alone.tracked && alone.innovation.surprise() < kWrongSurprise &&
                    alone.matched_share >= std::max(kGoodShare, kUsualPart * usual_share_);
  const MotionPrior& prior = by_prior.prediction;
  const Pose3 found = poses_.back().pose.inverse() * alone.registered;
  if (fits && !differs(found, prior)) return alone;
  // No robot moves as that source says, or it was contradicted too often.
  const bool impossible = differs(prior.motion, alone.prediction);
  if (fits && (impossible || ++contradictions_in_a_row_ >= kBelieved)) {
    if (contradicted_++ == 0) first_contradicted_ = stamp;
    addDoubt(logSE3(prior.motion.inverse() * found));
    return alone;
  }
  Located follows = by_prior;
  follows.odom_T_base = poses_.back().pose * prior.motion;
  follows.information.setZero();
  follows.tracked = false;
  if (alone.tracked || by_prior.tracked)
    addDoubt(logSE3(
        prior.motion.inverse() *
        (by_prior.tracked ? Pose3(poses_.back().pose.inverse() * by_prior.registered) : found)));
  return follows;
}

/** Two sources disagree, and whichever is believed may be the wrong one. */
void LidarOdometry::addDoubt(const Vector6d& disagreement) {
  doubt_ += diagonal(disagreement.head<3>().norm(), disagreement.tail<3>().norm());
}

/** Where the motion during the sweep is not measured but part of what is sought, scan and pose
 * follow from one another. What gyros have measured of it stays. */
LidarOdometry::Located LidarOdometry::locateAlone(double stamp,
                                                  const std::optional<MeasuredRotation>& turn,
                                                  const FilteredScan& scan, bool anywhere) {
  constexpr int kPasses = 6;
  constexpr double kSmallM = 0.01;
  const double seconds = stamp - poses_.back().stamp;
  const MotionPrior motion = constantVelocity(seconds, turn);
  if (scan.time.empty()) return locate(scan, motion, anywhere);
  const double sweep = *std::max_element(scan.time.begin(), scan.time.end());
  const double radius = radiusOf(scan.points);
  const auto twistOf = [&](const Pose3& found) {
    Vector6d twist = logSE3(found) / seconds;
    if (turn) twist.tail<3>() = scan.twist.tail<3>();
    return twist;
  };
  FilteredScan corrected = undistortedBy(twistOf(motion.motion), scan);
  Located located = locate(corrected, motion, anywhere);
  for (int pass = 1; pass < kPasses; ++pass) {
    // A scan that is bent much may not settle yet, and still tell the way.
    if (located.matched_share < options.min_matched_share) break;
    const Vector6d found = twistOf(poses_.back().pose.inverse() *
                                   (located.tracked ? located.odom_T_base : located.registered));
    const Vector6d change = (found - corrected.twist) * sweep;
    if (change.head<3>().norm() + radius * change.tail<3>().norm() < kSmallM) break;
    // Half way: a scan that is bent too far the one way gives a motion that bends it as far the
    // other way.
    corrected = undistortedBy(pass < 3 ? found : Vector6d(0.5 * (corrected.twist + found)), scan);
    located = locate(corrected, motion, false, located.registered);
  }
  located.points = std::move(corrected.points);
  return located;
}

/** Not of a scan that shows too little: until one shows more, the robot follows the other source.
 */
void LidarOdometry::beginMap(const FilteredScan& scan, const Pose3& odom_T_base) {
  if (scan.points.size() < kFewestPoints) return;
  map_ = std::make_unique<LocalMap>(leafFor(scan), planar_);
  inserted_at_.reset();
  extendMap(scan, odom_T_base);
}

/** The scan decides where the surfaces hold it, the prediction where they do not.
 * \param anywhere also looks where no prediction points to, if need be.
 * \param nearby a pose that lies closer than what the prediction can promise. */
LidarOdometry::Located LidarOdometry::locate(const FilteredScan& scan, const MotionPrior& motion,
                                             bool anywhere, const std::optional<Pose3>& nearby) {
  Located located;
  const Pose3 predicted = poses_.back().pose * motion.motion;
  const Matrix6d Ad = adjoint(motion.motion.inverse());
  const Matrix6d P = Ad * covariance_.pose() * Ad.transpose() + motion.covariance;
  located.prediction = motion;
  located.odom_T_base = predicted;

  if (!map_ || scan.planar != planar_) return located;
  const Vector6d sigmas = P.diagonal().cwiseSqrt();
  const double error =
      kSigmas * (sigmas.head<3>().maxCoeff() + sigmas.tail<3>().maxCoeff() * radiusOf(scan.points));
  const double good_share = std::max(kGoodShare, kGoodPart * usual_share_);
  const ScanToMapResult found = nearby ? registerToMap(scan.points, *map_, *nearby, 0)
                                       : searchInMap(scan, predicted, error, good_share,
                                                     anywhere ? reference_.get() : nullptr, *map_);
  located.registered = found.map_T_scan;
  located.matched_share = found.matched_share;
  located.tracked = found.converged && found.matched_share >= options.min_matched_share;
  if (!located.tracked) return located;

  located.information =
      registrationInformation(found.surface, found.map_T_scan, options.information, planar_)
          .information;
  if (planar_) located.information = inPlane(located.information);
  const Matrix6d& information = located.information;
  // S⁻¹ = (P + I⁻¹)⁻¹ = I (1 + P I)⁻¹, which needs no inverse of what may be singular.
  located.innovation = {logSE3(predicted.inverse() * found.map_T_scan),
                        information * (Matrix6d::Identity() + P * information).inverse()};
  // What all patches have in common is mostly common to the scans in the map, too. It counts little
  // here, or the map would follow a source that errs evenly.
  RegistrationInformationOptions apart = options.information;
  apart.common_share = kCommonShareInMap;
  Matrix6d sharp =
      registrationInformation(found.surface, found.map_T_scan, apart, planar_).information;
  if (planar_) sharp = inPlane(sharp);
  located.odom_T_base = normalized(
      predicted * expSE3(Vector6d(P * sharp * (Matrix6d::Identity() + P * sharp).inverse() *
                                  located.innovation.difference)));
  return located;
}

void LidarOdometry::accept(double stamp, const FilteredScan& scan, const Located& located) {
  const Pose3 motion = poses_.back().pose.inverse() * located.odom_T_base;
  covariance_.predict(located.prediction.motion, located.prediction.covariance);
  covariance_.update(located.information);
  last_motion_ = motion;
  last_motion_s_ = stamp - poses_.back().stamp;
  travelled_m_ += motion.translation().norm();
  path_since_kept_m_ += motion.translation().norm();
  poses_.push_back({stamp, located.odom_T_base});
  while (poses_.size() > 2 && poses_[1].stamp <= stamp - kKeptS) poses_.pop_front();

  if (located.tracked)
    usual_share_ +=
        (usual_share_ > 0 ? kShareMemory : 1.0) * (located.matched_share - usual_share_);
  lost_in_a_row_ = located.tracked ? 0 : lost_in_a_row_ + 1;
  lost_s_ = located.tracked ? 0 : lost_s_ + last_motion_s_;
  if (!located.tracked && lost_++ == 0) first_lost_ = stamp;
  if (!map_ || lost_in_a_row_ >= kLostForGood)
    beginMap(scan, located.odom_T_base);
  else if (located.tracked)
    extendMap(scan, located.odom_T_base);
}

void LidarOdometry::extendMap(const FilteredScan& scan, const Pose3& odom_T_base) {
  reference_ = std::make_unique<LocatedScan>(LocatedScan{odom_T_base, scan.points});
  const Pose3 since =
      inserted_at_ ? Pose3(inserted_at_->inverse() * odom_T_base) : Pose3::Identity();
  if (inserted_at_ && since.translation().norm() < options.insert_distance_m &&
      rotationAngle(since) < options.insert_angle_deg * kDegree)
    return;
  inserted_at_ = odom_T_base;
  map_->add(scan.points, odom_T_base, scan.origin, travelled_m_);
  map_->forget(travelled_m_ - kRememberedM, odom_T_base.translation().cast<float>(),
               static_cast<float>(kReach) * farthest(scan.points));
}

std::vector<std::string> LidarOdometry::warnings() const {
  std::vector<std::string> result;
  if (lost_ > 0)
    result.push_back(std::to_string(lost_) + " of " + std::to_string(scans_) +
                     " scans could not be registered to the local map, the first of them at " +
                     formatFixed(*first_lost_, 3) +
                     ": their motion is that of another odometry source, or what the robot did "
                     "before");
  if (contradicted_ > 0)
    result.push_back("the lidar contradicts the recorded odometry in " +
                     std::to_string(contradicted_) + " of " + std::to_string(scans_) +
                     " scans, the first of them at " + formatFixed(*first_contradicted_, 3) +
                     ": their motion is that of the lidar alone");
  return result;
}

}  // namespace lamp
