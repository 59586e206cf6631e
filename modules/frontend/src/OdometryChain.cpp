#include "OdometryChain.h"

#include <algorithm>

#include "lamp/input/ScanFromObservation.h"

namespace lamp {

namespace {

/** Scan odometry does not wait longer than this for what another source says of a scan; keyed scans
 * are seconds apart. Seconds of the recording. */
constexpr double kPatienceS = 1.0, kKeyedPatienceS = 10.0;

/** Stamps of scans and of odometry agree to this part of the time between two scans, or better than
 * this, seconds: drivers add delays of their own, and robots speed up and turn between two
 * readings.
 */
constexpr double kStampShare = 0.25, kMostStampS = 0.25;

}  // namespace

OdometryChain::OdometryChain(std::vector<std::shared_ptr<OdometrySource>> sources, bool keyed,
                             const MotionModelOptions& motion)
    : keyed_(keyed), motion_(motion) {
  for (auto& source : sources) {
    auto tracker = std::dynamic_pointer_cast<ScanOdometry>(source);
    if (tracker && !tracker_)
      tracker_ = std::move(tracker);
    else
      others_.push_back(std::move(source));
  }
  if (!tracker_) tracks_ = false;
  if (others_.empty()) tracks_ = true;
}

void OdometryChain::observe(const InputObservation& observation) {
  if (isLidar(*observation.observation)) newest_ = std::max(newest_, observation.stamp);
  gyros_.observe(observation);
  if (tracker_) tracker_->observe(observation);
  for (const auto& source : others_) source->observe(observation);
}

/** The first of the others that knows anything. */
OdometrySource* OdometryChain::recorded() const {
  for (const auto& source : others_)
    if (source->covers(0)) return source.get();
  return others_.empty() ? nullptr : others_.front().get();
}

OdometrySource& OdometryChain::main() const {
  return tracks() ? *tracker_ : *recorded();
}

bool OdometryChain::ready(double stamp) {
  const OdometrySource* const other = recorded();
  const bool covered = other && other->covers(stamp + stamp_sigma_s_);
  const bool waited = newest_ > stamp + (keyed_ ? kKeyedPatienceS : kPatienceS);
  if (!tracks_ && (covered || waited)) tracks_ = !keyed_ || !covered;
  if (!gyros_.covers(stamp) && !waited) return false;
  return covered || (tracks() && (waited || others_.empty()));
}

void OdometryChain::finish() {
  if (!tracks_) tracks_ = !keyed_ || !recorded()->covers(0);
}

bool OdometryChain::recordedKnows(double from, double to) const {
  const OdometrySource* const other = recorded();
  return other && other->knows(from) && other->knows(to) && other->covers(std::max(from, to));
}

std::optional<Pose3> OdometryChain::recordedPose(double stamp) const {
  if (!recordedKnows(stamp, stamp)) return std::nullopt;
  return recorded()->poseAt(stamp);
}

Pose3 OdometryChain::motion(double from, double to) const {
  Pose3 motion = motionWithoutGyros(from, to);
  if (const auto turn = this->turn(from, to)) motion.linear() = turn->rotation;
  return motion;
}

/** Of a robot in the plane the turn there. */
std::optional<MeasuredRotation> OdometryChain::turn(double from, double to) const {
  auto turn = gyros_.between(from, to);
  if (turn && planar_) turn->rotation = planarPose(0, 0, yawOf(Pose3(turn->rotation))).linear();
  return turn;
}

Pose3 OdometryChain::motionWithoutGyros(double from, double to) const {
  if (recordedKnows(from, to)) return recorded()->poseAt(from).inverse() * recorded()->poseAt(to);
  if (!tracks()) return main().poseAt(from).inverse() * main().poseAt(to);
  return tracker_->predictedMotion(from).inverse() * tracker_->predictedMotion(to);
}

std::optional<MotionPrior> OdometryChain::prior(double from, double to) const {
  if (!recordedKnows(from, to)) return std::nullopt;
  OdometrySource& source = *recorded();
  const Pose3 motion = source.poseAt(from).inverse() * source.poseAt(to);
  const auto covariance = source.covarianceBetween(from, to);
  return MotionPrior{motion, source.doubtBetween(from, to) + stampCovariance(from, to, motion) +
                                 (covariance ? *covariance : stepCovariance(motion, motion_))};
}

/** By how much the motion would be another one if stamps were off: not at all for a robot that
 * moves evenly. */
Matrix6d OdometryChain::stampCovariance(double from, double to, const Pose3& motion) const {
  Matrix6d covariance = Matrix6d::Zero();
  for (const double shift : {-stamp_sigma_s_, stamp_sigma_s_}) {
    if (!recordedKnows(from + shift, to + shift)) continue;
    const Pose3 shifted =
        recorded()->poseAt(from + shift).inverse() * recorded()->poseAt(to + shift);
    const Vector6d change = logSE3(motion.inverse() * shifted);
    covariance.diagonal().head<3>().array() += 0.5 * change.head<3>().squaredNorm();
    covariance.diagonal().tail<3>().array() += 0.5 * change.tail<3>().squaredNorm();
  }
  return covariance;
}

Pose3 OdometryChain::track(double stamp, FilteredScan& scan) {
  ScanMotion known;
  planar_ = scan.planar;
  if (last_) stamp_sigma_s_ = std::min(kMostStampS, kStampShare * (stamp - *last_));
  if (last_) known = {prior(*last_, stamp), turn(*last_, stamp)};
  const Pose3 odom_T_base = tracker_->track(stamp, known, scan);
  if (const auto seen = tracker_->seenOrientation()) gyros_.compare(stamp, *seen);
  last_ = stamp;
  if (OdometrySource* const other = recorded()) comparison_.observe({stamp, odom_T_base}, *other);
  return odom_T_base;
}

bool OdometryChain::planar() const {
  const OdometrySource* const other = recorded();
  return !other || other->planar();
}

std::vector<std::string> OdometryChain::warnings() const {
  std::vector<std::string> result = gyros_.warnings();
  for (const auto& source : others_)
    for (std::string& warning : source->warnings()) result.push_back(std::move(warning));
  if (tracker_)
    for (std::string& warning : tracker_->warnings()) result.push_back(std::move(warning));
  for (std::string& warning : comparison_.warnings()) result.push_back(std::move(warning));
  return result;
}

}  // namespace lamp
