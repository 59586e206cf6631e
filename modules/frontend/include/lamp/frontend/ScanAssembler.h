#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "lamp/frontend/SweepGatherer.h"
#include "lamp/input/ObservationSource.h"
#include "lamp/input/ScanFromObservation.h"

namespace lamp {

/** Lidar observations of one robot that make up one scan. */
struct ScanParts {
  double stamp = 0;  ///< seconds, UTC: the scan's
  std::vector<InputObservation> observations;
};

class LidarRoster;

/** Says which lidar observations of a robot make up one scan. */
class ScanAssembler {
 public:
  virtual ~ScanAssembler() = default;
  /** Nothing before `stamp` (seconds, UTC) will come.
   *  \return the scan that is complete by this, if one is. */
  virtual std::optional<ScanParts> advanceTo(double stamp) = 0;
  /** Takes the robot's observations in time order, those that are no lidar too.
   *  \return the scans that are complete by this. */
  virtual std::vector<ScanParts> observe(const InputObservation& observation) = 0;
  /** No more observations will come. \return the scan that still waited for some. */
  virtual std::optional<ScanParts> finish() = 0;
  /** What a user should know, in words. */
  virtual std::vector<std::string> warnings() const = 0;
};

/** Raw recordings: each scan of the reference lidar, the first one seen, is joined by the latest
 * scan of each other lidar, unless that is too old. A scan is one observation, or several where a
 * driver cuts sweeps into pieces or the lidar's mount turns. If the reference lidar falls silent,
 * the next one that speaks takes its place. */
class ReferenceLidarScans : public ScanAssembler {
 public:
  ReferenceLidarScans(double merge_window_s, const ScanOptions& options);
  ~ReferenceLidarScans() override;

  std::optional<ScanParts> advanceTo(double) override { return std::nullopt; }
  std::vector<ScanParts> observe(const InputObservation& observation) override;
  std::optional<ScanParts> finish() override;
  std::vector<std::string> warnings() const override;

 private:
  std::vector<ScanParts> takeScan(const InputObservation& observation);
  bool begins(const InputObservation& observation);
  void changeReference(const InputObservation& observation);

  const double merge_window_s_;
  const ScanOptions options_;
  const std::unique_ptr<LidarRoster> roster_;
  std::optional<SweepGatherer> gatherer_{SweepGatherer()};
  std::optional<ScanParts> open_;  ///< not yet known to be complete
  bool stands_alone_ = true;       ///< the last observation; the next one begins a scan
  std::vector<std::string> warnings_;
  std::optional<std::string> reference_;
  std::map<std::string, InputObservation> latest_other_;
};

/** Keyed recordings: the scans of one stamp belong together, in whatever order they come. A scan is
 * complete when time has moved on. */
class SameStampScans : public ScanAssembler {
 public:
  std::optional<ScanParts> advanceTo(double stamp) override;
  std::vector<ScanParts> observe(const InputObservation& observation) override;
  std::optional<ScanParts> finish() override;
  std::vector<std::string> warnings() const override;

 private:
  void takeLidar(const InputObservation& observation);

  std::optional<ScanParts> open_;
  std::optional<double> newest_;
  size_t late_ = 0;
};

}  // namespace lamp
