#pragma once

#include <string>
#include <vector>

#include "lamp/evaluation/TimeJoin.h"

namespace lamp::evaluation {

/** How an estimate is laid onto the truth before it is compared. */
enum class Alignment {
  kNone,   ///< not at all: both are in one world frame
  kFirst,  ///< the first pose of each component's first robot is made to coincide
  kTeam,   ///< one rigid transform a component, least squares; hides a shift of the whole map
  kSe3,    ///< one a robot; hides errors between robots as well
};
const char* toString(Alignment alignment);
/** One sentence for reports. */
const char* describe(Alignment alignment);
/** \throws std::runtime_error that lists the words. */
Alignment alignmentFromText(const std::string& text);

/** `truth_T_estimate` that brings the estimated positions nearest to the true ones, in least
 * squares (Umeyama 1991, without scale). Orientations count as 1 cm of position, which decides only
 * where positions do not: on a straight line, or on one spot.
 * \param planar rotates about z and moves in x and y only. \param poses not empty. */
Pose3 fitRigid(const std::vector<JoinedPose>& poses, bool planar);

/** A robot's trajectory, and where it belongs. */
struct AlignmentMember {
  const std::vector<JoinedPose>* poses = nullptr;  ///< not empty
  size_t component = 0;
  bool planar = false;
};
/** `truth_T_estimate` of each robot. */
std::vector<Pose3> align(Alignment alignment, const std::vector<AlignmentMember>& robots);

}  // namespace lamp::evaluation
