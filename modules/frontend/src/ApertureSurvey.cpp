#include "lamp/frontend/ApertureSurvey.h"

#include <mrpt/obs/CObservation2DRangeScan.h>

#include <cmath>

#include "ApertureCheck.h"

namespace lamp {

namespace {

using mrpt::obs::CObservation2DRangeScan;

constexpr double kDegree = M_PI / 180.0;

/** Lasers are sold with these; turning tells to about so many percent. */
constexpr double kUsual[] = {90, 180, 240, 270, 360};
constexpr double kTolerance = 0.08;

/** Scans wait for the odometry that follows them. */
constexpr size_t kMaxWaiting = 200;

double nearestUsual(double degrees) {
  double best = std::round(degrees), least = kTolerance;
  for (const double usual : kUsual) {
    const double ratio = std::abs(std::log(degrees / usual));
    if (ratio < least) least = ratio, best = usual;
  }
  return best;
}

}  // namespace

ApertureSurvey::ApertureSurvey() : check_(std::make_unique<ApertureCheck>()) {}
ApertureSurvey::~ApertureSurvey() = default;
ApertureSurvey::ApertureSurvey(ApertureSurvey&&) noexcept = default;

void ApertureSurvey::observe(const InputObservation& observation) {
  odometry_.observe(observation);
  const bool is_laser =
      dynamic_cast<const CObservation2DRangeScan*>(observation.observation.get()) != nullptr;
  if (is_laser && !label_) label_ = observation.label;
  if (is_laser && observation.label == *label_ && waiting_.size() < kMaxWaiting)
    waiting_.push_back(observation);
  while (!waiting_.empty() && odometry_.covers(waiting_.front().stamp)) {
    const InputObservation& front = waiting_.front();
    const auto& laser = dynamic_cast<const CObservation2DRangeScan&>(*front.observation);
    if (odometry_.knows(front.stamp))
      check_->observe(laser, laser.aperture, odometry_.poseAt(front.stamp));
    waiting_.pop_front();
  }
}

bool ApertureSurvey::decided() const {
  return check_->decided();
}

std::optional<ApertureSurvey::Correction> ApertureSurvey::correction() const {
  const auto seen = check_->contradiction();
  if (!seen) return std::nullopt;
  return Correction{check_->used() / kDegree, *seen / kDegree, nearestUsual(*seen / kDegree)};
}

}  // namespace lamp
