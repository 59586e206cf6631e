#include "lamp/frontend/GateStart.h"

#include <utility>

#include "lamp/input/ExtrasFromObservation.h"
#include "lamp/input/OdometryFromObservation.h"

namespace lamp {

namespace {

/** What odometry may wander by while a robot stands. */
constexpr double kStandM = 0.03, kStandRad = 0.5 * M_PI / 180.0;
/** A sweep takes as long as this, and odometry needs a little until it tells of a motion. */
constexpr double kSettingOffS = 0.2;

bool isMotion(const Pose3& motion) {
  return motion.translation().norm() > kStandM || rotationAngle(motion) > kStandRad;
}

}  // namespace

GateStart::GateStart(const GateOptions& gate, const ScanOptions& scan)
    : gate_(gate), scan_(scan), calibration_(gate) {}

void GateStart::observe(const InputObservation& observation) {
  if (result_) return;
  if (hasMoved(observation)) {
    takeUpTo(observation.stamp - kSettingOffS);
    decide();
  } else if (begin_ && observation.stamp > *begin_ + gate_.standing_s) {
    takeUpTo(observation.stamp);
    decide();
  } else if (isLidar(*observation.observation) || inertialFromObservation(observation)) {
    recent_.push_back(observation);
    if (!begin_ && isLidar(*observation.observation)) begin_ = observation.stamp;
    takeUpTo(observation.stamp - kSettingOffS);
  }
}

/** Since the first scan. */
bool GateStart::hasMoved(const InputObservation& observation) {
  const auto reading = odometryFromObservation(*observation.observation);
  if (!reading) return false;
  if (!begin_ || !odom_T_start_) odom_T_start_ = reading->odom_T_base;
  return isMotion(odom_T_start_->inverse() * reading->odom_T_base);
}

void GateStart::takeUpTo(double stamp) {
  for (; !recent_.empty() && recent_.front().stamp <= stamp; recent_.pop_front()) {
    const InputObservation& observation = recent_.front();
    if (const auto inertial = inertialFromObservation(observation)) {
      calibration_.addForce(inertial->specific_force);
      continue;
    }
    try {
      const auto scan = scanFromObservation(*observation.observation, observation.label, scan_);
      if (!scan) continue;
      calibration_.add(*scan);
      ++scans_;
    } catch (const std::exception&) {
      // The front end counts scans that cannot be read.
    }
  }
}

void GateStart::decide() {
  recent_.clear();
  result_ = scans_ > 0 ? calibration_.solve()
                       : GateResult{std::nullopt, "the robot does not stand at the beginning"};
  calibration_ = GateCalibration(gate_);
}

std::vector<KeyNodePacket> GateStart::pass(std::vector<KeyNodePacket> packets) {
  for (KeyNodePacket& packet : packets) waiting_.push_back(std::move(packet));
  if (!result_ && waiting_.size() > 1 &&
      isMotion(waiting_.front().odom_T_base.inverse() * waiting_.back().odom_T_base))
    decide();
  if (!result_) return {};
  for (KeyNodePacket& packet : waiting_)
    if (packet.id.index == 0 && result_->pose) packet.prior = result_->pose;
  return std::exchange(waiting_, {});
}

std::vector<KeyNodePacket> GateStart::finish() {
  if (!result_) {
    if (!recent_.empty()) takeUpTo(recent_.back().stamp);
    decide();
  }
  return pass({});
}

std::vector<std::string> GateStart::warnings() const {
  if (!result_ || result_->pose) return {};
  return {"the gate does not tell where the robot starts: " + result_->reason};
}

}  // namespace lamp
