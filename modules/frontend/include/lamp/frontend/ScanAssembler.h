#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "lamp/input/ObservationSource.h"

namespace lamp {

/** Lidar observations of one robot that make up one scan. */
struct ScanParts {
  double stamp = 0;  ///< seconds, UTC: the scan's
  std::vector<InputObservation> observations;
};

/** Says which lidar observations of a robot make up one scan. */
class ScanAssembler {
 public:
  virtual ~ScanAssembler() = default;
  /** Takes all observations of the robot, in time order; those that are no lidar tell the time.
   *  \return the scan that is complete by this, if one is. */
  virtual std::optional<ScanParts> observe(const InputObservation& observation) = 0;
  /** No more observations will come. \return the scan that still waited for some. */
  virtual std::optional<ScanParts> finish() = 0;
  /** What a user should know, in words. */
  virtual std::vector<std::string> warnings() const = 0;
};

/** Raw recordings: each scan of the reference lidar, the first one seen, is joined by the latest
 * scan of each other lidar, unless that is too old. */
class ReferenceLidarScans : public ScanAssembler {
 public:
  explicit ReferenceLidarScans(double merge_window_s) : merge_window_s_(merge_window_s) {}

  std::optional<ScanParts> observe(const InputObservation& observation) override;
  std::optional<ScanParts> finish() override { return std::nullopt; }
  std::vector<std::string> warnings() const override { return {}; }

 private:
  const double merge_window_s_;
  std::optional<std::string> reference_;
  std::map<std::string, InputObservation> latest_other_;
};

/** Keyed recordings: the scans of one stamp belong together, in whatever order they come. A scan is
 * complete when time has moved on. */
class SameStampScans : public ScanAssembler {
 public:
  std::optional<ScanParts> observe(const InputObservation& observation) override;
  std::optional<ScanParts> finish() override;
  std::vector<std::string> warnings() const override;

 private:
  void takeLidar(const InputObservation& observation);

  std::optional<ScanParts> open_;
  std::optional<double> newest_;
  size_t late_ = 0;
};

}  // namespace lamp
