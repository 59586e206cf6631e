#include "lamp/loop_priority/CandidateQueue.h"

#include <algorithm>
#include <iterator>

namespace lamp {

void CandidateQueue::push(std::vector<LoopClosureCandidate> candidates) {
  std::move(candidates.begin(), candidates.end(), std::back_inserter(waiting_));
}

std::vector<LoopClosureCandidate> CandidateQueue::take(size_t budget, Prioritizer& prioritizer,
                                                       const PoseGraph& graph,
                                                       const UncertaintyQuery& uncertainty) {
  prioritizer.order(waiting_, graph, uncertainty);
  const size_t count = budget == 0 ? waiting_.size() : std::min(budget, waiting_.size());
  const auto end = waiting_.begin() + static_cast<std::ptrdiff_t>(count);
  std::vector<LoopClosureCandidate> taken(std::make_move_iterator(waiting_.begin()),
                                          std::make_move_iterator(end));
  waiting_.erase(waiting_.begin(), end);
  return taken;
}

}  // namespace lamp
