#include "lamp/maps/Occupancy.h"

#include <mrpt/system/COutputLogger.h>

#include <algorithm>
#include <optional>

#include "MapPoints.h"
#include "OccupancyMap.h"
#include "OccupiedSpace.h"

namespace lamp {

void OccupancyOptions::visit(OptionVisitor& v) {
  v("resolution_m", resolution_m, "m", "size of a voxel of the octree, and of a cell of the grids",
    kPositive);
  v("max_range_m", max_range_m, "m",
    "longer rays are cut at this range: they mark free space but no obstacle", kPositive);
  v("tolerance_m", tolerance_m, "m",
    "when maps are written again, scans of which no point moved farther stay as they are",
    kNotNegative);
  v("driven_ground", driven_ground,
    "the ground under robots' ways is occupied and their bodies' space free, seen or not");
  v("body_radius_m", body_radius_m, "m", "radius of a robot's body", kPositive);
  v("body_height_m", body_height_m, "m",
    "height of a robot's body above the ground; what is higher is no obstacle", kPositive);
  v("max_step_m", max_step_m, "m", "highest step that a robot climbs", kPositive);
  v("max_slope_deg", max_slope_deg, "deg", "steepest slope that a robot climbs", Range{0, 80});
}

namespace {

bool areSame(const std::vector<MapTrack>& a, const std::vector<MapTrack>& b) {
  const auto same_pose = [](const StampedPose& p, const StampedPose& q) {
    return p.stamp == q.stamp && p.pose.matrix() == q.pose.matrix();
  };
  const auto same_track = [&](const MapTrack& s, const MapTrack& t) {
    return std::equal(s.poses.begin(), s.poses.end(), t.poses.begin(), t.poses.end(), same_pose);
  };
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), same_track);
}

}  // namespace

struct Occupancy::Memory {
  explicit Memory(const OccupancyMap::Options& options) : evidence(options) {}

  OccupancyMap evidence;
  std::vector<MapTrack> tracks;
  std::optional<OccupiedSpace> space;  ///< of the evidence and tracks
  mrpt::system::COutputLogger logger{"occupancy"};
};

Occupancy::Occupancy(const OccupancyOptions& options)
    : options_(options),
      memory_(std::make_unique<Memory>(
          OccupancyMap::Options{options.resolution_m, options.max_range_m, options.tolerance_m})) {}

Occupancy::~Occupancy() = default;

OccupiedSpace& Occupancy::of(const ComponentMap& map) {
  checkMap(map);
  Memory& memory = *memory_;
  const bool scans_changed = memory.evidence.update(map);
  if (!memory.space || scans_changed || !areSame(memory.tracks, map.tracks)) {
    memory.tracks = map.tracks;
    memory.space.emplace(memory.evidence, map, options_);
  }
  if (scans_changed && memory.evidence.raysOutOfBounds() > 0)
    memory.logger.logFmt(
        mrpt::system::LVL_WARN,
        "%zu rays end beyond the range of an octree with voxels of %g m and are left out",
        memory.evidence.raysOutOfBounds(), options_.resolution_m);
  return *memory.space;
}

}  // namespace lamp
