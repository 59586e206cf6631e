#pragma once

#include <memory>
#include <string>
#include <vector>

#include "lamp/maps/MapExporter.h"

namespace lamp {

class OccupancyMap;

struct OctoMapOptions {
  double resolution_m = 0.2;
  double max_range_m = 15.0;
  double tolerance_m = 0.0;
  bool driven_ground = true;
  double body_radius_m = 0.5;
  double body_height_m = 0.8;

  void visit(OptionVisitor& v) {
    v("resolution_m", resolution_m, "m", "voxel size", kPositive);
    v("max_range_m", max_range_m, "m",
      "longer rays are cut at this range: they mark free space but no obstacle", kPositive);
    v("tolerance_m", tolerance_m, "m",
      "when the map is written again, scans of which no point moved farther stay as they are",
      kNotNegative);
    v("driven_ground", driven_ground,
      "the ground under robots' ways is occupied and their bodies' space free, seen or not");
    v("body_radius_m", body_radius_m, "m", "radius of a robot's body, for driven_ground",
      kPositive);
    v("body_height_m", body_height_m, "m",
      "height of a robot's body above the ground, for driven_ground", kPositive);
  }
};

/** `<stem>.ot` (log-odds) and `<stem>.bt` (occupied, free, unknown): occupancy in the format of
 * Hornung et al., "OctoMap", Autonomous Robots 2013. Frame of the map, metres; its offset from the
 * world in a line `# offset X Y Z`. The model: docs/maps.md.
 *
 * Keeps its evidence: exporting a map again costs what changed since. */
class OctoMap : public MapExporter {
  DEFINE_MRPT_OBJECT(OctoMap, lamp)

 public:
  OctoMap() = default;
  explicit OctoMap(const OctoMapOptions& options) : options_(options) {}

  void visit(OptionVisitor& options) override { options_.visit(options); }
  std::vector<std::string> exportMap(const ComponentMap& map, const std::string& stem) override;

 private:
  OctoMapOptions options_;
  std::shared_ptr<OccupancyMap> occupancy_;
};

}  // namespace lamp
