#include "MostUncertain.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

IMPLEMENTS_MRPT_OBJECT(MostUncertain, lamp::Prioritizer, lamp)

namespace lamp {

void MostUncertain::order(std::vector<LoopClosureCandidate>& candidates, const PoseGraph&,
                          const UncertaintyQuery& uncertainty) {
  // One question for each `from` costs far less than one for each candidate.
  std::map<KeyNodeId, std::vector<LoopClosureCandidate*>> by_from;
  for (LoopClosureCandidate& candidate : candidates) by_from[candidate.from].push_back(&candidate);
  for (const auto& [from, group] : by_from) {
    std::vector<KeyNodeId> to;
    for (const LoopClosureCandidate* candidate : group) to.push_back(candidate->to);
    const auto covariances = uncertainty.relativeCovariances(from, to);
    for (size_t i = 0; i < group.size(); ++i)
      group[i]->priority = covariances[i] ? std::sqrt(covariances[i]->topLeftCorner<3, 3>().trace())
                                          : std::numeric_limits<double>::infinity();
  }
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const auto& a, const auto& b) { return a.priority > b.priority; });
}

}  // namespace lamp
