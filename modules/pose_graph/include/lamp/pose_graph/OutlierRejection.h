#pragma once

#include <vector>

#include "lamp/core/PoseGraph.h"
#include "lamp/core/Stage.h"

namespace lamp {

/** How far two robots that no start poses relate are from a common map. */
struct FrameAgreement {
  RobotId a, b;
  size_t loops = 0;     ///< between the two
  size_t agreeing = 0;  ///< of those, how many agree, each with key nodes of its own
  size_t needed = 0;
  bool joined = false;
  /** Where several placements of b's first key node in the frame of a's explain about equally well
   * what both robots have seen, those, and the robots stay apart; the best first. */
  std::vector<Pose3> equally_good = {};
  /** Where what both have seen contradicts the placement that the loops agree on: by what share of
   * the surfaces that can be compared. The robots stay apart then. */
  double contradicting = 0;
};

/** Decides before the optimisation which loop closures may take part in it (paper II-D). */
class OutlierRejection : public Stage {
  DEFINE_VIRTUAL_MRPT_OBJECT(OutlierRejection)

 public:
  /** \param admitted one flag for each edge; those of loops that must stay out are cleared. Loops
   *  that are out already are not looked at. */
  virtual void reject(const PoseGraph& graph, std::vector<bool>& admitted) = 0;
  /** Of the last reject(): by how much covariances of odometry are larger than stated. */
  virtual double odometryScale() const { return 1.0; }
  /** Of the last reject(). */
  virtual std::vector<FrameAgreement> agreements() const { return {}; }
};

}  // namespace lamp
