#pragma once

#include <vector>

#include "lamp/loop_priority/Prioritizer.h"

namespace lamp {

/** Candidates that wait for their computation. */
class CandidateQueue {
 public:
  void push(std::vector<LoopClosureCandidate> candidates);
  size_t size() const { return waiting_.size(); }

  /** Orders all that waits and takes the first ones.
   *  \param budget how many at most, 0 for all. */
  std::vector<LoopClosureCandidate> take(size_t budget, Prioritizer& prioritizer,
                                         const PoseGraph& graph,
                                         const UncertaintyQuery& uncertainty);

 private:
  std::vector<LoopClosureCandidate> waiting_;
};

}  // namespace lamp
