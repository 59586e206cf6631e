// What every prioritizer must hold to, whoever wrote it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "StageSuite.h"
#include "lamp/loop_priority/Prioritizer.h"

namespace lamp {
namespace {

using namespace test;

constexpr RobotId kA{0}, kB{1};

/** Knows less the farther two key nodes lie apart in sequence; between robots nothing. */
struct GrowingUncertainty : UncertaintyQuery {
  std::vector<std::optional<Matrix6d>> relativeCovariances(
      KeyNodeId from, const std::vector<KeyNodeId>& to) const override {
    std::vector<std::optional<Matrix6d>> covariances;
    for (const KeyNodeId id : to) {
      const double steps = std::abs(double(id.index) - double(from.index));
      covariances.push_back(id.robot == from.robot
                                ? std::optional<Matrix6d>(steps * 1e-3 * Matrix6d::Identity())
                                : std::nullopt);
    }
    return covariances;
  }
};

PoseGraph line() {
  PoseGraph graph;
  for (const RobotId robot : {kA, kB})
    for (uint32_t i = 0; i < 30; ++i) {
      Node node;
      node.id = {robot, i};
      node.world_T_base = planarPose(2.0 * i, 5.0 * robot.value, 0);
      graph.addNode(node);
    }
  return graph;
}

/** In no order: within robots and between them, some pairs at the same distance. */
std::vector<LoopClosureCandidate> candidates() {
  std::vector<LoopClosureCandidate> list;
  for (const uint32_t i : {17, 3, 29, 11, 5, 23}) {
    list.push_back({{kA, i / 2}, {kA, i}, "near", 0});
    list.push_back({{kA, i}, {kB, 29 - i}, "far", 0});
  }
  return list;
}

using Row = std::tuple<KeyNodeId, KeyNodeId, std::string>;
std::vector<Row> rows(const std::vector<LoopClosureCandidate>& list) {
  std::vector<Row> result;
  for (const LoopClosureCandidate& c : list) result.emplace_back(c.from, c.to, c.generator);
  return result;
}
std::vector<Row> sortedRows(const std::vector<LoopClosureCandidate>& list) {
  std::vector<Row> result = rows(list);
  std::sort(result.begin(), result.end());
  return result;
}

std::vector<std::string> prioritizers() {
  registerAllClasses_lamp_core();
  registerAllClasses_lamp_loop_priority();
  return stageClasses(CLASS_ID(Prioritizer));
}

class AnyPrioritizer : public testing::TestWithParam<std::string> {
 protected:
  std::shared_ptr<Prioritizer> make() const { return makeDefault<Prioritizer>(GetParam()); }

  const std::shared_ptr<Prioritizer> prioritizer = make();
  const PoseGraph graph = line();
  const GrowingUncertainty uncertainty;
};
INSTANTIATE_TEST_SUITE_P(All, AnyPrioritizer, testing::ValuesIn(prioritizers()), testName);

TEST_P(AnyPrioritizer, LosesAndAddsNothing) {
  std::vector<LoopClosureCandidate> list = candidates();
  prioritizer->order(list, graph, uncertainty);
  EXPECT_EQ(sortedRows(list), sortedRows(candidates()));
}

TEST_P(AnyPrioritizer, PutsTheHighestPriorityFirst) {
  std::vector<LoopClosureCandidate> list = candidates();
  for (size_t i = 0; i < list.size(); ++i) list[i].priority = std::nan("");
  prioritizer->order(list, graph, uncertainty);
  for (size_t i = 0; i < list.size(); ++i) {
    EXPECT_FALSE(std::isnan(list[i].priority)) << "each gets one";
    if (i > 0) {
      EXPECT_GE(list[i - 1].priority, list[i].priority);
    }
  }
}

TEST_P(AnyPrioritizer, TiesKeepTheirOrder) {
  std::vector<LoopClosureCandidate> list(7, {{kA, 3}, {kA, 20}, "", 0});
  for (size_t i = 0; i < list.size(); ++i) list[i].generator = std::to_string(i);
  const std::vector<Row> before = rows(list);
  prioritizer->order(list, graph, uncertainty);
  EXPECT_EQ(rows(list), before);
}

TEST_P(AnyPrioritizer, TakesFewOrNone) {
  std::vector<LoopClosureCandidate> none;
  prioritizer->order(none, graph, uncertainty);
  EXPECT_TRUE(none.empty());
  std::vector<LoopClosureCandidate> one = {candidates().front()};
  prioritizer->order(one, graph, uncertainty);
  EXPECT_EQ(rows(one), std::vector<Row>{rows(candidates()).front()});
}

TEST_P(AnyPrioritizer, SaysTheSameTwiceAndKeepsNothingOfOtherLists) {
  std::vector<LoopClosureCandidate> first = candidates(), second = candidates(), other;
  other.push_back({{kB, 1}, {kB, 28}, "other", 5});
  prioritizer->order(first, graph, uncertainty);
  prioritizer->order(other, graph, uncertainty);
  prioritizer->order(second, graph, uncertainty);
  EXPECT_EQ(rows(first), rows(second));
  std::vector<LoopClosureCandidate> fresh = candidates();
  make()->order(fresh, graph, uncertainty);
  EXPECT_EQ(rows(first), rows(fresh));
}

}  // namespace
}  // namespace lamp
