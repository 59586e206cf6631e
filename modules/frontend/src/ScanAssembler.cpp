#include "lamp/frontend/ScanAssembler.h"

#include <algorithm>
#include <utility>

#include "LidarRoster.h"
#include "lamp/core/Csv.h"
#include "lamp/input/ScanFromObservation.h"

namespace lamp {

ReferenceLidarScans::ReferenceLidarScans(double merge_window_s, const ScanOptions& options)
    : merge_window_s_(merge_window_s),
      options_(options),
      roster_(std::make_unique<LidarRoster>()) {}

ReferenceLidarScans::~ReferenceLidarScans() = default;

std::vector<ScanParts> ReferenceLidarScans::observe(const InputObservation& observation) {
  const InputObservation named = roster_->take(observation);
  // What is known of sweeps is that of two lidars.
  if (named.label != observation.label && latest_other_.count(named.label) == 0)
    gatherer_.emplace();
  return isLidar(*observation.observation) ? takeScan(named) : std::vector<ScanParts>();
}

std::vector<ScanParts> ReferenceLidarScans::takeScan(const InputObservation& observation) {
  if (!reference_ ||
      (observation.label != *reference_ && roster_->isSilent(*reference_, observation.stamp)))
    changeReference(observation);
  if (observation.label != *reference_) {
    latest_other_[observation.label] = observation;
    return {};
  }
  std::vector<ScanParts> complete;
  const auto close = [&] {
    if (open_) complete.push_back(std::move(*std::exchange(open_, std::nullopt)));
  };
  if (gatherer_->wholeScans() || begins(observation)) {
    close();
    open_ = ScanParts{observation.stamp, {}};
    for (const auto& [label, other] : latest_other_)
      if (observation.stamp - other.stamp <= merge_window_s_) open_->observations.push_back(other);
  }
  // The reference lidar's own come first.
  auto& parts = open_->observations;
  const auto other = std::find_if(parts.begin(), parts.end(), [&](const InputObservation& part) {
    return part.label != observation.label;
  });
  parts.insert(other, observation);
  if (gatherer_->wholeScans()) close();
  return complete;
}

/** \return whether the observation is the first of a scan. One that shows nothing, or cannot be
 * read, stands alone. */
bool ReferenceLidarScans::begins(const InputObservation& observation) {
  const bool follows_one_alone = std::exchange(stands_alone_, true);
  try {
    const auto scan = scanFromObservation(*observation.observation, observation.label, options_);
    if (!scan || scan->points.empty()) return true;
    mrpt::poses::CPose3D pose;
    observation.observation->getSensorPose(pose);
    const Pose3 base_T_sensor(
        pose.getHomogeneousMatrixVal<mrpt::math::CMatrixDouble44>().asEigen());
    stands_alone_ = false;
    return gatherer_->begins(observation.stamp, base_T_sensor, *scan) || follows_one_alone;
  } catch (const std::exception&) {  // MRPT throws logic errors for missing files
    return true;
  }
}

std::optional<ScanParts> ReferenceLidarScans::finish() {
  return std::exchange(open_, std::nullopt);
}

void ReferenceLidarScans::changeReference(const InputObservation& observation) {
  if (reference_) {
    warnings_.push_back("the lidar '" + *reference_ + "' is silent after " +
                        formatFixed(roster_->lastOf(*reference_), 3) +
                        "; key nodes are made of scans of '" + observation.label +
                        "' from then on");
    roster_->excuse(*reference_);
  }
  reference_ = observation.label;
  latest_other_.erase(observation.label);
  gatherer_.emplace();
}

std::vector<std::string> ReferenceLidarScans::warnings() const {
  std::vector<std::string> result = warnings_;
  for (std::string& warning : roster_->warnings()) result.push_back(std::move(warning));
  return result;
}

std::optional<ScanParts> SameStampScans::advanceTo(double stamp) {
  return open_ && stamp > open_->stamp ? finish() : std::nullopt;
}

std::vector<ScanParts> SameStampScans::observe(const InputObservation& observation) {
  std::vector<ScanParts> complete;
  if (auto scan = advanceTo(observation.stamp)) complete.push_back(std::move(*scan));
  if (isLidar(*observation.observation)) takeLidar(observation);
  return complete;
}

void SameStampScans::takeLidar(const InputObservation& observation) {
  if (!newest_ || observation.stamp > *newest_) {
    newest_ = observation.stamp;
    open_ = ScanParts{observation.stamp, {}};
  }
  if (open_ && observation.stamp == open_->stamp)
    open_->observations.push_back(observation);
  else
    ++late_;
}

std::optional<ScanParts> SameStampScans::finish() {
  return std::exchange(open_, std::nullopt);
}

std::vector<std::string> SameStampScans::warnings() const {
  if (late_ == 0) return {};
  return {std::to_string(late_) +
          " clouds were dropped: they came after later observations, when "
          "the keyed scan of their stamp was complete"};
}

}  // namespace lamp
