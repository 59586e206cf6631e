#pragma once

#include <string>
#include <vector>

#include "lamp/core/Options.h"
#include "lamp/core/Trajectory.h"
#include "lamp/simulation/RayCaster.h"

namespace lamp::simulation {

struct RadioOptions {
  double beacon_spacing_m = 50;
  double rate_hz = 1;
  double range_m = 80;
  double antenna_m = 0.4;
  double loss_at_1m_db = 40;
  double exponent = 2.2;
  double wall_loss_db = 25;
  double shadowing_db = 3;
  double max_loss_db = 95;

  void visit(OptionVisitor& v);
};

/** A radio that a robot left on its way; stays where it is. */
struct Beacon {
  std::string name;          ///< `robot-0`, `robot-1`, ...
  Eigen::Vector3d position;  ///< world; where the base of the robot was
  double since = 0;          ///< stamp at which it was dropped
};

/** One beacon after each `spacing_m` of a robot's way, at its true position. */
std::vector<Beacon> dropBeacons(const TrajectoryInterpolator& truth, const std::string& robot,
                                double spacing_m);

struct RssiReading {
  double stamp = 0;
  size_t beacon = 0;  ///< place in the list of beacons
  double path_loss_db = 0;
};

/** Path loss grows with the logarithm of the distance (Rappaport's log-distance model), by a fixed
 * loss where a wall is between, and varies by shadowing. Antennas are `antenna_m` above the base.
 */
class Radio {
 public:
  /** \param caster must outlive the radio. */
  Radio(RadioOptions options, const RayCaster& caster);
  /** Without shadowing, between two base positions. World, metres. */
  double expectedLoss(const Eigen::Vector3d& from, const Eigen::Vector3d& to) const;
  /** What a robot hears of all beacons, also of other robots, once they are dropped: those within
   * `range_m` whose loss is at most `max_loss_db`. By stamp, then by beacon. */
  std::vector<RssiReading> listen(const TrajectoryInterpolator& truth,
                                  const std::vector<Beacon>& beacons, uint64_t seed) const;

 private:
  RadioOptions options_;
  const RayCaster& caster_;
};

}  // namespace lamp::simulation
