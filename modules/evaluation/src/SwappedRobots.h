#pragma once

#include <vector>

#include "lamp/evaluation/RunFiles.h"
#include "lamp/evaluation/TimeJoin.h"

namespace lamp::evaluation {

struct NamedTrajectory {
  RunFiles::Robot robot;
  const std::vector<JoinedPose>* poses = nullptr;
};

/** \throws std::runtime_error if two trajectories, each laid as well as possible onto the truth,
 * both fit the other one's truth much better than their own: then files were exchanged, and all
 * figures would be nonsense. */
void refuseSwappedRobots(const std::vector<NamedTrajectory>& robots, const TruthFolder& truth);

}  // namespace lamp::evaluation
