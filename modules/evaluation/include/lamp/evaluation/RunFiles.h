#pragma once

#include <string>
#include <vector>

#include "lamp/core/RunFolder.h"

namespace lamp::evaluation {

/** What the evaluation needs to know from a run's summary.json. */
struct RunFiles {
  struct Robot {
    std::string name;
    bool planar = false;   ///< mapped in x, y and yaw only
    size_t component = 0;  ///< the largest one that the robot is in
  };
  struct Component {
    std::string map;                  ///< path without extension
    std::vector<std::string> robots;  ///< whose largest component this is
  };

  RunFolder folder{""};
  bool interrupted = false;
  std::vector<Robot> robots;
  std::vector<Component> components;  ///< largest first

  /** Robots without a trajectory in the folder are left out.
   *  \throws std::runtime_error if the folder is missing, has no summary (the run was killed, or
   *  still runs) or no trajectories. */
  static RunFiles open(const std::string& root);
};

}  // namespace lamp::evaluation
