#pragma once

#include <set>
#include <string>
#include <utility>
#include <vector>

#include "lamp/base_station/Ledger.h"
#include "lamp/base_station/OperatorActions.h"
#include "lamp/core/PoseGraph.h"

namespace lamp {

/** What the operator's actions have done so far to the graph and to what happens to it. */
class OperatorState {
 public:
  /** Applies an action to graph and ledger. \return `done`, or why it cannot be done. */
  std::string apply(const OperatorAction& action, size_t round, const RobotTable& robots,
                    PoseGraph& graph, Ledger& ledger);

  bool frozen() const { return frozen_; }
  /** One flag per edge: false for loops removed or vetoed, and for those of ignored robots. */
  std::vector<bool> admitted(const PoseGraph& graph) const;
  /** Whether a loop closure between the two may be searched for. */
  bool maySearch(KeyNodeId from, KeyNodeId to) const;
  bool removed(EdgeIndex edge) const { return removed_.count(edge) != 0; }

 private:
  using Pair = std::pair<KeyNodeId, KeyNodeId>;

  std::string change(const OperatorAction& action, size_t round, const RobotTable& robots,
                     PoseGraph& graph, Ledger& ledger);
  std::string applyToLoop(const OperatorAction& action, const RobotTable& robots,
                          const PoseGraph& graph, const Ledger& ledger);
  std::string add(const OperatorAction& action, size_t round, const RobotTable& robots,
                  PoseGraph& graph, Ledger& ledger);
  std::string applyToRobot(const OperatorAction& action, const RobotTable& robots,
                           const PoseGraph& graph);
  void restore(EdgeIndex edge, Pair pair);
  void reset();
  void pinEdges(PoseGraph& graph) const;

  std::set<EdgeIndex> removed_;  ///< and vetoed
  std::set<EdgeIndex> pinned_;
  std::set<EdgeIndex> added_;
  std::set<Pair> vetoed_;
  std::set<RobotId> ignored_;
  bool frozen_ = false;
};

}  // namespace lamp
