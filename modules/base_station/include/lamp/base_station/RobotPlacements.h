#pragma once

#include <map>
#include <utility>
#include <vector>

#include "lamp/base_station/PlacementScales.h"
#include "lamp/core/PoseGraph.h"
#include "lamp/pose_graph/Optimizer.h"

namespace lamp {

/** Joins robots that no start poses relate only if there is one placement of the one in the other's
 * map that explains what both have seen better than all others.
 *
 * Loop closures that agree are no proof: in a corridor with a pillar every few metres all of them
 * may share one mistake. So when an optimisation has joined two robots by such loop closures, other
 * placements are sought and compared with that one (PlacementScales, judge()). Where several are
 * equally good, the loop closures between the two robots stay out; where another one is better,
 * those that agree with the worse ones do. The answer holds until the robots have seen a good deal
 * more. */
class RobotPlacements {
 public:
  /** The arguments must outlive the object. */
  RobotPlacements(const LoopClosureComputation& computation, PreparedScanStore& scans)
      : computation_(computation), scans_(scans) {}

  /** Clears the loop closures that earlier answers keep out. */
  void exclude(const PoseGraph& graph, std::vector<bool>& admitted) const;
  /** Looks at the robots that the result joins anew. \return whether one of them is to be placed
   * otherwise, or not at all: then the result must not be used. */
  bool judge(const PoseGraph& graph, const OptimizationResult& result);
  /** Loop closures for placements that judge() has found better than those of the result; each is
   * given once. */
  std::vector<PlacedLoop> takeLoops() { return std::exchange(loops_, {}); }
  /** Adds what was found to the frames of the last optimisation. */
  void describe(std::vector<FrameAgreement>& frames) const;
  /** From now on answers expire as soon as the robots have seen more. \return whether one has
   * expired. */
  bool askForLastAnswers(const PoseGraph& graph);

 private:
  /** Answers hold until both robots together have this many times as many key nodes. */
  static constexpr double kGrowth = 1.5;
  using Robots = std::pair<RobotId, RobotId>;
  /** Placements are those of b's first key node in the frame of a's. */
  struct Answer {
    FrameAgreement agreement;
    size_t key_nodes = 0;  ///< of both robots together
    Pose3 best = Pose3::Identity();
    std::vector<Pose3> others;  ///< all that were compared with it
    bool apart = false;         ///< whether the two must not be joined
    bool as_joined = true;      ///< the best is the one that the loop closures agreed on
  };

  bool holds(const Answer& answer, const PoseGraph& graph) const;
  Answer answer(const PoseGraph& joined, const FrameAgreement& agreement);
  bool excludes(const Answer& answer, const PoseGraph& graph, const Edge& edge) const;

  const LoopClosureComputation& computation_;
  PreparedScanStore& scans_;
  double growth_ = kGrowth;
  std::map<Robots, Answer> answers_;
  std::vector<PlacedLoop> loops_;
};

}  // namespace lamp
