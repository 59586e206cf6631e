#include "lamp/loop_priority/CandidateQueue.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace lamp {
namespace {

struct NoUncertainty : UncertaintyQuery {
  std::vector<std::optional<Matrix6d>> relativeCovariances(
      KeyNodeId, const std::vector<KeyNodeId>& to) const override {
    return std::vector<std::optional<Matrix6d>>(to.size());
  }
};

/** Prefers high indices of `to`. */
class Newest : public Arrival {
 public:
  void order(std::vector<LoopClosureCandidate>& candidates, const PoseGraph&,
             const UncertaintyQuery&) override {
    for (auto& c : candidates) c.priority = c.to.index;
    std::stable_sort(candidates.begin(), candidates.end(),
                     [](const auto& a, const auto& b) { return a.priority > b.priority; });
  }
};

std::vector<LoopClosureCandidate> candidates(std::initializer_list<uint32_t> to) {
  std::vector<LoopClosureCandidate> result;
  for (const uint32_t index : to)
    result.push_back({{RobotId{0}, 0}, {RobotId{0}, index}, "test", 0});
  return result;
}

std::vector<uint32_t> indices(const std::vector<LoopClosureCandidate>& list) {
  std::vector<uint32_t> result;
  for (const auto& c : list) result.push_back(c.to.index);
  return result;
}

TEST(CandidateQueue, ArrivalKeepsTheOrderAndTheBudget) {
  CandidateQueue queue;
  Arrival arrival;
  const PoseGraph graph;
  queue.push(candidates({5, 3}));
  queue.push(candidates({4}));
  EXPECT_EQ(indices(queue.take(2, arrival, graph, NoUncertainty{})), (std::vector<uint32_t>{5, 3}));
  EXPECT_EQ(queue.size(), 1u);
  EXPECT_EQ(indices(queue.take(0, arrival, graph, NoUncertainty{})), (std::vector<uint32_t>{4}));
  EXPECT_TRUE(queue.take(0, arrival, graph, NoUncertainty{}).empty());
}

TEST(CandidateQueue, APairWaitsOnce) {
  CandidateQueue queue;
  Arrival arrival;
  const PoseGraph graph;
  EXPECT_EQ(queue.push(candidates({5, 3, 5})), 2u);
  EXPECT_EQ(queue.push(candidates({3, 4})), 1u);
  EXPECT_EQ(indices(queue.take(2, arrival, graph, NoUncertainty{})), (std::vector<uint32_t>{5, 3}));
  EXPECT_EQ(queue.push(candidates({5, 4})), 1u) << "5 has been taken, 4 still waits";
}

TEST(CandidateQueue, LaterCandidatesCanOvertake) {
  CandidateQueue queue;
  Newest newest;
  const PoseGraph graph;
  queue.push(candidates({5, 3}));
  EXPECT_EQ(indices(queue.take(1, newest, graph, NoUncertainty{})), (std::vector<uint32_t>{5}));
  queue.push(candidates({9}));
  EXPECT_EQ(indices(queue.take(0, newest, graph, NoUncertainty{})), (std::vector<uint32_t>{9, 3}));
}

TEST(Arrival, TakesNoNoticeOfEarlierPriorities) {
  std::vector<LoopClosureCandidate> list = candidates({5, 3, 4});
  list[0].priority = 1;
  list[1].priority = 9;
  list[2].priority = 5;
  Arrival().order(list, PoseGraph(), NoUncertainty{});
  EXPECT_EQ(indices(list), (std::vector<uint32_t>{5, 3, 4}));
  for (const LoopClosureCandidate& candidate : list) EXPECT_EQ(candidate.priority, 0);
}

}  // namespace
}  // namespace lamp
