#pragma once

#include <string>
#include <vector>

#include "lamp/maps/MapExporter.h"

namespace lamp {

struct OctoMapOptions {
  double resolution_m = 0.2;
  double max_range_m = 15.0;
  double prob_hit = 0.7;
  double prob_miss = 0.4;
  double clamping_min = 0.12;
  double clamping_max = 0.97;
  double occupancy_threshold = 0.5;

  void visit(OptionVisitor& v) {
    // 0 and 1 are left out: they have no finite log-odds.
    constexpr Range kLikely{0.5, 0.999}, kUnlikely{0.001, 0.5}, kBetween{0.001, 0.999};
    v("resolution_m", resolution_m, "m", "voxel size", kPositive);
    v("max_range_m", max_range_m, "m",
      "longer rays are cut at this range: they mark free space but no obstacle", kPositive);
    v("prob_hit", prob_hit, "", "occupancy probability of a voxel after one hit", kLikely);
    v("prob_miss", prob_miss, "", "occupancy probability of a voxel after one pass", kUnlikely);
    v("clamping_min", clamping_min, "", "lower bound on the occupancy probability", kUnlikely);
    v("clamping_max", clamping_max, "", "upper bound on the occupancy probability", kLikely);
    v("occupancy_threshold", occupancy_threshold, "",
      "voxels at or above this probability are occupied in the .bt file", kBetween);
  }
};

/** `<stem>.ot` (log-odds) and `<stem>.bt` (occupied, free, unknown): an occupancy octree after
 * Hornung et al., "OctoMap", Autonomous Robots 2013. Frame of the map,
 * metres; its offset from the world in a line `# offset X Y Z`.
 *
 * Each scan changes a voxel once; where one ray of the scan ends and others pass, the end wins.
 * Rays start at the origin of the sensor that saw the point. */
class OctoMap : public MapExporter {
  DEFINE_MRPT_OBJECT(OctoMap, lamp)

 public:
  OctoMap() = default;
  explicit OctoMap(const OctoMapOptions& options) : options_(options) {}

  void visit(OptionVisitor& options) override { options_.visit(options); }
  std::vector<std::string> exportMap(const ComponentMap& map, const std::string& stem) override;

 private:
  OctoMapOptions options_;
};

}  // namespace lamp
