#include "lamp/input/ScanFromObservation.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "MrptPoses.h"
#include "SensorReturns.h"

namespace lamp {
namespace {

using mrpt::obs::CObservation;
using mrpt::obs::CObservation2DRangeScan;
using mrpt::obs::CObservation3DRangeScan;
using mrpt::obs::CObservationPointCloud;
using mrpt::obs::CObservationRotatingScan;
using mrpt::obs::CObservationVelodyneScan;

constexpr double kLevel = 2.0 * M_PI / 180.0;
constexpr float kMaxSweepS = 1.0f;

template <class T>
bool is(const CObservation& observation) {
  return dynamic_cast<const T*>(&observation) != nullptr;
}

template <class T>
bool takeReturns(const CObservation& observation, std::optional<SensorReturns>& returns) {
  const auto* typed = dynamic_cast<const T*>(&observation);
  if (typed) returns = returnsOf(*typed);
  return typed != nullptr;
}

std::optional<SensorReturns> returnsOfAny(const CObservation& observation) {
  std::optional<SensorReturns> returns;
  takeReturns<CObservationPointCloud>(observation, returns) ||
      takeReturns<CObservationVelodyneScan>(observation, returns) ||
      takeReturns<CObservationRotatingScan>(observation, returns) ||
      takeReturns<CObservation3DRangeScan>(observation, returns) ||
      takeReturns<CObservation2DRangeScan>(observation, returns) ||
      takeReturns<CObservationTimedPoints>(observation, returns);
  return returns;
}

/** How much each of the sensor's own axes points up on the robot. */
Eigen::Vector3d upInSensor(const CObservation& observation) {
  mrpt::poses::CPose3D pose;
  observation.getSensorPose(pose);
  return poseFromMrpt(pose).linear().row(2);
}

/** The robot's body in the base frame; empty where none is set. */
Eigen::AlignedBox3f boxOf(const std::vector<double>& corners) {
  Eigen::AlignedBox3f box;
  for (size_t i = 0; i + 3 <= corners.size(); i += 3)
    box.extend(Eigen::Vector3d(corners[i], corners[i + 1], corners[i + 2]).cast<float>());
  return box;
}

/** Times in milliseconds or of another clock would tear a scan apart. */
void checkTimes(const std::vector<float>& times) {
  if (times.empty()) return;
  const auto [first, last] = std::minmax_element(times.begin(), times.end());
  const bool finite =
      std::all_of(times.begin(), times.end(), [](float t) { return std::isfinite(t); });
  if (finite && *last - *first <= kMaxSweepS && std::max(*last, -*first) <= kMaxSweepS) return;
  throw std::runtime_error("the times of its points reach from " + std::to_string(*first) + " to " +
                           std::to_string(*last) +
                           " s after its stamp; a sweep takes no more than 1 s: are they in "
                           "another unit than seconds, or of another clock?");
}

}  // namespace

void ScanOptions::visit(OptionVisitor& v) {
  v("min_range_m", min_range_m, "m", "closer returns are dropped", kNotNegative);
  v("max_range_m", max_range_m, "m", "farther returns are dropped", kPositive);
  v("laser_aperture_deg", laser_aperture_deg, "deg",
    "field of view of 2D lasers if the recording states it wrongly; 0 keeps the recorded one",
    {0, 360});
  v("body_box", body_box, 6, "m",
    "two opposite corners [x y z x y z] of a box in the base frame: returns within it are those of "
    "the robot's own body and are dropped; empty keeps all");
}

bool isLidar(const CObservation& o) {
  return is<CObservationPointCloud>(o) || is<CObservationVelodyneScan>(o) ||
         is<CObservationRotatingScan>(o) || is<CObservation3DRangeScan>(o) ||
         is<CObservation2DRangeScan>(o) || is<CObservationTimedPoints>(o);
}

bool isPlanarLaser(const CObservation& observation) {
  if (!is<CObservation2DRangeScan>(observation)) return false;
  const Eigen::Vector3d up = upInSensor(observation);
  return up.head<2>().cwiseAbs().maxCoeff() < std::sin(kLevel);
}

double laserTilt(const CObservation& observation) {
  return std::acos(std::min(1.0, std::abs(upInSensor(observation).z())));
}

std::optional<Scan> scanFromObservation(const CObservation& observation, const std::string& label,
                                        const ScanOptions& options) {
  auto returns = returnsOfAny(observation);
  if (!returns) return {};
  if (const auto* laser = dynamic_cast<const CObservation2DRangeScan*>(&observation);
      laser && options.laser_aperture_deg > 0) {
    CObservation2DRangeScan corrected = *laser;
    corrected.aperture = static_cast<float>(options.laser_aperture_deg * M_PI / 180.0);
    returns = returnsOf(corrected);
  }
  mrpt::poses::CPose3D sensor_pose;
  observation.getSensorPose(sensor_pose);
  const Pose3 base_T_sensor = poseFromMrpt(sensor_pose);
  const Eigen::Isometry3f transform = base_T_sensor.cast<float>();
  if (!transform.matrix().allFinite())
    throw std::runtime_error("its sensor pose is not finite: the recording is damaged");
  const Eigen::AlignedBox3f body = boxOf(options.body_box);
  const double max_range = std::min(options.max_range_m, returns->max_range_m);

  Scan scan;
  scan.sensors.push_back({label, base_T_sensor.translation()});
  scan.points.reserve(returns->points.size());
  const bool has_intensity = !returns->intensity.empty();
  const bool has_times = !returns->time.empty();
  for (size_t i = 0; i < returns->points.size(); ++i) {
    const Eigen::Vector3f& point = returns->points[i];
    const double range = point.cast<double>().norm();
    // Written so that a range that is not a number fails; zero is the mark of a missing return.
    if (!(range > 0 && range >= options.min_range_m && range <= max_range)) continue;
    const Eigen::Vector3f in_base = transform * point;
    if (!in_base.allFinite() || body.contains(in_base)) continue;
    scan.points.push_back(in_base);
    if (has_intensity) scan.intensity.push_back(returns->intensity[i]);
    if (has_times) scan.time.push_back(returns->time[i]);
  }
  checkTimes(scan.time);
  scan.sensor.assign(scan.points.size(), 0);
  return scan;
}

}  // namespace lamp
