#include "lamp/frontend/ScanAssembler.h"

#include <utility>

#include "lamp/input/ScanFromObservation.h"

namespace lamp {

std::optional<ScanParts> ReferenceLidarScans::observe(const InputObservation& observation) {
  if (!isLidar(*observation.observation)) return std::nullopt;
  if (!reference_) reference_ = observation.label;
  if (observation.label != *reference_) {
    latest_other_[observation.label] = observation;
    return std::nullopt;
  }
  ScanParts scan{observation.stamp, {observation}};
  for (const auto& [label, other] : latest_other_)
    if (observation.stamp - other.stamp <= merge_window_s_) scan.observations.push_back(other);
  return scan;
}

std::optional<ScanParts> SameStampScans::observe(const InputObservation& observation) {
  std::optional<ScanParts> complete;
  if (open_ && observation.stamp > open_->stamp) complete = finish();
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
