// What every candidate generator must hold to, whoever wrote it.
#include <gtest/gtest.h>

#include <limits>
#include <set>
#include <utility>

#include "StageSuite.h"
#include "lamp/loop_candidates/CandidateGenerator.h"

namespace lamp {
namespace {

using namespace test;

constexpr RobotId kA{0}, kB{1};
constexpr uint32_t kLap = 24;

/** Laps around (x, 0), each a little wider, so that no two distances are the same; robots with a
 * prior share a frame. */
void addLaps(PoseGraph& graph, RobotId robot, uint32_t count, double x, bool with_prior) {
  for (uint32_t i = 0; i < count; ++i) {
    const double angle = 2 * M_PI * i / kLap, radius = 12 + 0.03 * i;
    Node node;
    node.id = {robot, i};
    node.planar = true;
    node.world_T_base = planarPose(x + radius * std::cos(angle), radius * std::sin(angle), angle);
    graph.addNode(node);
  }
  if (!with_prior) return;
  Edge prior;
  prior.type = EdgeType::kPrior;
  prior.from = prior.to = {robot, 0};
  graph.addEdge(prior);
}

PoseGraph team(bool common_frame) {
  PoseGraph graph;
  addLaps(graph, kA, 2 * kLap, 0, true);
  addLaps(graph, kB, 2 * kLap, 3, common_frame);
  return graph;
}

/** All that can be compared of a list of candidates. */
std::vector<std::pair<KeyNodeId, KeyNodeId>> pairs(
    const std::vector<LoopClosureCandidate>& candidates) {
  std::vector<std::pair<KeyNodeId, KeyNodeId>> result;
  for (const LoopClosureCandidate& c : candidates) result.emplace_back(c.from, c.to);
  return result;
}

std::vector<std::string> generators() {
  registerAllClasses_lamp_core();
  registerAllClasses_lamp_loop_candidates();
  return stageClasses(CLASS_ID(CandidateGenerator));
}

class AnyCandidateGenerator : public testing::TestWithParam<std::string> {
 protected:
  std::shared_ptr<CandidateGenerator> make() const {
    return makeDefault<CandidateGenerator>(GetParam());
  }
  const std::shared_ptr<CandidateGenerator> generator = make();
};
INSTANTIATE_TEST_SUITE_P(All, AnyCandidateGenerator, testing::ValuesIn(generators()), testName);

TEST_P(AnyCandidateGenerator, ProposesPairsOfTheCurrentKeyNodeOnce) {
  size_t proposed = 0;
  for (const bool common_frame : {true, false}) {
    const PoseGraph graph = team(common_frame);
    for (const Node& node : graph.nodes()) {
      std::set<KeyNodeId> others;
      for (const LoopClosureCandidate& c : generator->propose(graph, node.id)) {
        ++proposed;
        ASSERT_TRUE(graph.contains(c.from) && graph.contains(c.to));
        ASSERT_NE(c.from == node.id, c.to == node.id) << "one end is the current key node";
        EXPECT_LT(graph.place(c.from), graph.place(c.to)) << "the older one comes first";
        EXPECT_TRUE(others.insert(c.from == node.id ? c.to : c.from).second) << "proposed twice";
        EXPECT_EQ(c.generator, GetParam());
      }
    }
  }
  EXPECT_GT(proposed, 0u) << "in one frame or in two there is something to propose";
}

TEST_P(AnyCandidateGenerator, ComparesNoEstimatesOfDifferentFrames) {
  // Where robot B stands in a frame of its own means nothing to A: moving it changes nothing.
  const PoseGraph graph = team(false);
  PoseGraph moved = graph;
  for (const KeyNodeId id : graph.robotNodes(kB))
    moved.node(id).world_T_base = planarPose(500, -70, 2) * graph.node(id).world_T_base;
  for (const Node& node : graph.nodes())
    EXPECT_EQ(pairs(generator->propose(graph, node.id)), pairs(generator->propose(moved, node.id)));
}

TEST_P(AnyCandidateGenerator, SaysTheSameTwiceAndKeepsNothingOfOtherGraphs) {
  const PoseGraph graph = team(true);
  const PoseGraph other = team(false);
  for (const Node& node : graph.nodes()) {
    generator->propose(other, node.id);
    EXPECT_EQ(pairs(generator->propose(graph, node.id)), pairs(make()->propose(graph, node.id)));
  }
}

TEST_P(AnyCandidateGenerator, HasNothingForTheFirstKeyNode) {
  PoseGraph graph;
  addLaps(graph, kA, 1, 0, true);
  EXPECT_TRUE(generator->propose(graph, {kA, 0}).empty());
}

TEST_P(AnyCandidateGenerator, SurvivesEstimatesThatAreNoNumbers) {
  for (const bool common_frame : {true, false}) {
    PoseGraph graph = team(common_frame);
    const KeyNodeId broken{kB, kLap};
    graph.node(broken).world_T_base.translation().x() = std::numeric_limits<double>::quiet_NaN();
    for (const Node& node : graph.nodes()) {
      std::set<KeyNodeId> others;
      for (const LoopClosureCandidate& c : generator->propose(graph, node.id))
        EXPECT_TRUE(others.insert(c.from == node.id ? c.to : c.from).second);
      if (common_frame) {
        EXPECT_EQ(others.count(broken), 0u) << "nothing is near to nowhere";
      }
    }
  }
}

}  // namespace
}  // namespace lamp
