#pragma once

#include <set>
#include <utility>
#include <vector>

#include "lamp/loop_priority/Prioritizer.h"

namespace lamp {

/** Candidates that wait for their computation. */
class CandidateQueue {
 public:
  /** Pairs that wait already are left out. \return how many are new. */
  size_t push(std::vector<LoopClosureCandidate> candidates);
  size_t size() const { return waiting_.size(); }

  /** Orders all that waits and takes the first ones.
   *  \param budget how many at most, 0 for all. */
  std::vector<LoopClosureCandidate> take(size_t budget, Prioritizer& prioritizer,
                                         const PoseGraph& graph,
                                         const UncertaintyQuery& uncertainty);

 private:
  std::vector<LoopClosureCandidate> waiting_;
  std::set<std::pair<KeyNodeId, KeyNodeId>> pairs_;  ///< of those
};

}  // namespace lamp
