#pragma once

#include <optional>
#include <vector>

#include "lamp/core/Ids.h"
#include "lamp/registration/LoopClosureComputation.h"
#include "lamp/registration/PreparedScanStore.h"
#include "lamp/scans/PatchEvidence.h"

namespace lamp {

/** A robot's key nodes and where they lie in its map. */
struct RobotMap {
  std::vector<KeyNodeId> nodes;
  std::vector<Pose3> map_T_node;
};

/** Two key nodes that a placement brings together, and what each says of the other's scan. */
struct ComparedPair {
  KeyNodeId a, b;
  PatchEvidence of_a, of_b;  ///< of the patches that a, or b, has seen

  double agreeing() const;
  double contradicting() const;
};

/** One robot's map moved against another's, and how both fit then. */
struct Placement {
  Pose3 a_T_b = Pose3::Identity();
  std::vector<ComparedPair> pairs;
  double near = 0;  ///< pairs near enough to be compared

  /** Agreeing patches, as if all near pairs had been compared. */
  double agreeing() const;
};

/** A loop closure that a placement has led to: `from` is a key node of a, `to` one of b. */
struct PlacedLoop {
  KeyNodeId from, to;
  Guess guess;
  LoopClosureAttempt attempt;
};

/** Weighs placements of robot b's map in robot a's by their keyed scans.
 *
 * Key nodes of the one that come near the other's are registered with them from where the placement
 * puts them; since maps drift, each may settle a little aside. Then their surfaces and their free
 * space are compared. Registrations are bounded: where more pairs are near, they are thinned
 * evenly. */
class PlacementScales {
 public:
  /** The arguments must outlive the object. \param a, b with at least one key node each. */
  PlacementScales(const RobotMap& a, const RobotMap& b, const LoopClosureComputation& computation,
                  PreparedScanStore& scans);

  Placement weigh(const Pose3& a_T_b) const;

  /** Other placements that registrations find: what b has seen at a few key nodes where `a_T_b`
   * brings both together is registered with all of a's map, along its way, either way round.
   * Those that are the same are given once, and `a_T_b` is not among them. */
  std::vector<Pose3> alternatives(const Pose3& a_T_b) const;

  /** Loop closures between key nodes that the placement brings together, those that are verified.
   */
  std::vector<PlacedLoop> loops(const Pose3& a_T_b) const;

 private:
  struct Pair {
    size_t a, b;
  };
  struct Start {
    Pair pair;
    Pose3 pose;  ///< of b's key node, seen from a's
  };

  std::vector<Pair> nearPairs(const Pose3& a_T_b) const;
  std::vector<Start> starts(const Pose3& a_T_b) const;
  Pose3 relativePose(const Pair& pair, const Pose3& a_T_b) const;
  Pose3 settled(const Start& start) const;
  LoopClosureAttempt registered(const Start& start) const;
  PreparedScanPtr scan(KeyNodeId id) const { return scans_.get(scans_.ofStrangers(id)); }

  const RobotMap &a_, &b_;
  const LoopClosureComputation& computation_;
  PreparedScanStore& scans_;
  double reach_m_ = 0;  ///< as far as most of a scan's points lie
};

/** Two placements are the same where they put a key node of b at about the same place. */
bool samePlacement(const Pose3& a_T_node, const Pose3& other_a_T_node);

}  // namespace lamp
