#pragma once

#include <map>
#include <optional>

#include "OccupancyCounts.h"
#include "lamp/maps/MapExporter.h"

namespace lamp {

/** The evidence of all keyed scans of a map, kept from one state of the map to the next: after a
 * loop closure only the scans that moved are taken out and put in again. The counts are those of a
 * map built from nothing at the poses that it was given, whatever came before. */
class OccupancyMap {
 public:
  struct Options {
    double resolution_m = 0.2;
    double max_range_m = 15.0;
    double tolerance_m = 0.0;  ///< scans that moved less keep their poses
  };

  explicit OccupancyMap(const Options& options) : options_(options) {}

  /** Makes the counts those of the map's key nodes. In parallel over scans and blocks; any number
   * of threads gives the same counts. \return whether they were others before. */
  bool update(const ComponentMap& map);

  const OccupancyCounts& counts() const { return counts_; }
  /** A stamp in the unit of the counts' times, not rounded. */
  double timeOf(double stamp) const { return (stamp - clock_->epoch) / clock_->second; }
  /** Scans of the last update that were taken out, and put in. */
  size_t removed() const { return removed_; }
  size_t inserted() const { return inserted_; }
  /** Rays of the last update left out because an end lies beyond the grid. */
  size_t raysOutOfBounds() const { return rays_out_of_bounds_; }

 private:
  /** How a scan is in the counts. */
  struct Entry {
    Pose3 world_T_base = Pose3::Identity();
    KeyedScanPtr scan;
    uint16_t time = 0;
    bool new_place = true;
  };
  using Entries = std::map<KeyNodeId, Entry>;

  /** Maps the stamps of a recording to 16 bits. */
  struct Clock {
    double epoch = 0;   ///< seconds
    double second = 1;  ///< seconds a unit, a power of two
    uint16_t at(double stamp) const;
    bool operator==(const Clock& o) const { return epoch == o.epoch && second == o.second; }
  };

  static Clock clockFor(const ComponentMap& map);
  Entries entriesOf(const ComponentMap& map, const Clock& clock) const;
  bool isSame(const Entry& a, const Entry& b) const;
  bool exchange(const Entries& wanted);
  bool forgetAll();
  template <class Take>
  void castInBatches(const std::vector<const Entry*>& entries, Take&& take);

  Options options_;
  OccupancyCounts counts_;
  Entries entries_;
  std::optional<Clock> clock_;
  size_t removed_ = 0, inserted_ = 0, rays_out_of_bounds_ = 0;
};

}  // namespace lamp
