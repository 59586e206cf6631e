#pragma once

#include <vector>

#include "lamp/core/KeyNodePacket.h"
#include "lamp/core/Options.h"
#include "lamp/simulation/RayCaster.h"
#include "lamp/simulation/Route.h"

namespace lamp::simulation {

struct DriveOptions {
  double speed_mps = 1.2;
  double turn_rate_dps = 40;
  double wander_m = 0.6;
  double sway_m = 0.01;
  double sway_deg = 0.8;
  double halt_every_m = 150;
  double halt_s = 8;
  double stand_s = 0;

  void visit(OptionVisitor& v);
};

/** True poses `world_T_base` of a robot that drives a route, 20 a second, from `start_stamp`. It
 * does not keep to the middle, cuts corners, slows down in curves, turns on the spot between legs,
 * sways with the ground, and halts now and then. The base is on the floor below the robot's middle.
 */
std::vector<StampedPose> drive(const std::vector<Leg>& route, const RayCaster& world,
                               const DriveOptions& options, double start_stamp, uint64_t seed);

}  // namespace lamp::simulation
