#pragma once

#include <memory>

#include "lamp/core/Options.h"

namespace lamp {

struct ComponentMap;
class OccupiedSpace;

/** Section `[occupancy]`. */
struct OccupancyOptions {
  double resolution_m = 0.2;
  double max_range_m = 15.0;
  double tolerance_m = 0.0;
  bool driven_ground = true;
  double body_radius_m = 0.5;
  double body_height_m = 0.8;
  double max_step_m = 0.2;
  double max_slope_deg = 30.0;

  void visit(OptionVisitor& v);
};

/** What the keyed scans of a map say of space, for all exporters that need it: the octree and the
 * grids agree, and the work is done once. The model: docs/maps.md.
 *
 * Keeps its evidence: asking again costs what changed since. */
class Occupancy {
 public:
  explicit Occupancy(const OccupancyOptions& options = {});
  ~Occupancy();
  Occupancy(const Occupancy&) = delete;

  const OccupancyOptions& options() const { return options_; }
  /** The same for the same map, whatever was asked before. \throws std::runtime_error if the map is
   * invalid. */
  OccupiedSpace& of(const ComponentMap& map);

 private:
  struct Memory;
  const OccupancyOptions options_;
  const std::unique_ptr<Memory> memory_;
};

}  // namespace lamp
