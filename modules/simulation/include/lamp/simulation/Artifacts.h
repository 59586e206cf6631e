#pragma once

#include <string>
#include <vector>

#include "lamp/core/Options.h"
#include "lamp/core/Trajectory.h"
#include "lamp/simulation/RayCaster.h"

namespace lamp::simulation {

/** Something to be found: backpack, survivor, phone, drill, extinguisher, ... */
struct Artifact {
  int id = 0;
  std::string kind;
  Eigen::Vector3d position;  ///< world, a little off any surface
};

struct ArtifactOptions {
  double range_m = 10;
  double rate_hz = 5;
  double camera_m = 0.4;
  double range_sigma_m = 0.2;
  double angle_sigma_deg = 1.5;
  double pass_gap_s = 10;

  void visit(OptionVisitor& v);
};

/** One artifact as a camera above the base sees it, in MRPT's convention: x forward, z up, `yaw` to
 * the left, `pitch` downwards. */
struct Sighting {
  double stamp = 0;
  int id = 0;
  double range_m = 0;
  double yaw_rad = 0;
  double pitch_rad = 0;
};

/** Each artifact once a pass, from where it was in sight and nearest; a pass ends when it was out
 * of sight or reach for `pass_gap_s`. By stamp, then by id. */
std::vector<Sighting> seeArtifacts(const std::vector<Artifact>& artifacts,
                                   const TrajectoryInterpolator& truth, const RayCaster& caster,
                                   const ArtifactOptions& options, uint64_t seed);

}  // namespace lamp::simulation
