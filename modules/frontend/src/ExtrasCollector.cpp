#include "lamp/frontend/ExtrasCollector.h"

#include "lamp/input/ExtrasFromObservation.h"

namespace lamp {

namespace {

/** If no odometry comes, memory must not grow. */
constexpr size_t kMaxWaiting = 10000;

LandmarkSighting moved(LandmarkSighting sighting, const Pose3& T) {
  sighting.base_p_sensor = T * sighting.base_p_sensor;
  sighting.base_p_landmark = T * sighting.base_p_landmark;
  return sighting;
}

RangeReading moved(RangeReading range, const Pose3& T) {
  range.base_p_antenna = T * range.base_p_antenna;
  return range;
}

GravityReading moved(GravityReading gravity, const Pose3& T) {
  gravity.base_up = T.linear() * gravity.base_up;
  return gravity;
}

double distance(const LandmarkSighting& sighting) {
  return (sighting.base_p_landmark - sighting.base_p_sensor).norm();
}

}  // namespace

void ExtrasCollector::observe(const InputObservation& observation) {
  for (LandmarkSighting& sighting : sightingsFromObservation(observation))
    waiting_.emplace_back(std::move(sighting));
  for (RangeReading& range : rangesFromObservation(observation)) waiting_.emplace_back(range);
  if (const auto inertial = inertialFromObservation(observation))
    if (const auto gravity = gravity_detector_.observe(observation.stamp, *inertial))
      waiting_.emplace_back(*gravity);
  while (waiting_.size() > kMaxWaiting) waiting_.pop_front();
}

void ExtrasCollector::advanceTo(double stamp, OdometrySource& odometry) {
  const auto stampOf = [](const auto& reading) { return reading.stamp; };
  const auto carry = [&](const auto& reading) {
    if (odometry.covers(reading.stamp) && odometry.knows(reading.stamp))
      place(moved(reading, odometry.poseAt(reading.stamp)));
  };
  while (!waiting_.empty() && std::visit(stampOf, waiting_.front()) <= stamp) {
    std::visit(carry, waiting_.front());
    waiting_.pop_front();
  }
}

void ExtrasCollector::place(const LandmarkSighting& sighting) {
  const auto [found, is_new] = sightings_.emplace(sighting.name, sighting);
  if (!is_new && distance(sighting) < distance(found->second)) found->second = sighting;
}

KeyNodeExtras ExtrasCollector::take(const Pose3& odom_T_base) {
  const Pose3 base_T_odom = odom_T_base.inverse();
  KeyNodeExtras extras;
  for (const auto& [name, sighting] : sightings_)
    extras.sightings.push_back(moved(sighting, base_T_odom));
  for (const auto& [beacon, range] : ranges_) extras.ranges.push_back(moved(range, base_T_odom));
  if (gravity_) extras.gravity = moved(*gravity_, base_T_odom);
  sightings_.clear();
  ranges_.clear();
  gravity_.reset();
  return extras;
}

}  // namespace lamp
