#include "lamp/loop_priority/CandidateQueue.h"

#include <algorithm>
#include <iterator>

namespace lamp {

size_t CandidateQueue::push(std::vector<LoopClosureCandidate> candidates) {
  const size_t before = waiting_.size();
  for (LoopClosureCandidate& candidate : candidates)
    if (pairs_.insert({candidate.from, candidate.to}).second)
      waiting_.push_back(std::move(candidate));
  return waiting_.size() - before;
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
  for (const LoopClosureCandidate& candidate : taken) pairs_.erase({candidate.from, candidate.to});
  return taken;
}

}  // namespace lamp
