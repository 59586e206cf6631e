#include "lamp/loop_candidates/GlobalSearch.h"

#include <algorithm>
#include <utility>

IMPLEMENTS_MRPT_OBJECT(GlobalSearch, lamp::CandidateGenerator, lamp)

namespace lamp {

void GlobalSearchOptions::visit(OptionVisitor& v) {
  v("max_per_robot", max_per_robot, "",
    "maximum number of candidates per key node and robot that does not yet share its frame", {1});
  v("max_other_robots", max_other_robots, "",
    "maximum number of such robots tried with one key node, in turn; bounds the time that many "
    "robots take",
    {1});
}

std::vector<LoopClosureCandidate> GlobalSearch::propose(const PoseGraph& graph,
                                                        KeyNodeId current) const {
  std::vector<RobotId> strangers;
  for (const RobotId robot : graph.robots())
    if (!graph.shareFrame(robot, current.robot)) strangers.push_back(robot);
  const size_t tried = std::min(strangers.size(), static_cast<size_t>(options.max_other_robots));
  std::vector<LoopClosureCandidate> candidates;
  for (size_t i = 0; i < tried; ++i) {
    const RobotId robot = strangers[(current.index * tried + i) % strangers.size()];
    const std::vector<KeyNodeId>& others = graph.robotNodes(robot);
    const size_t count = std::min(others.size(), static_cast<size_t>(options.max_per_robot));
    for (size_t k = 0; k < count; ++k) {
      const size_t place = (current.index + k * others.size() / count) % others.size();
      LoopClosureCandidate candidate{others[place], current, getLoggerName(), 0};
      if (graph.place(candidate.from) > graph.place(candidate.to))
        std::swap(candidate.from, candidate.to);
      candidates.push_back(candidate);
    }
  }
  return candidates;
}

}  // namespace lamp
