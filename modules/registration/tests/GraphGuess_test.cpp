#include "lamp/registration/GraphGuess.h"

#include <gtest/gtest.h>

namespace lamp {
namespace {

constexpr RobotId kA{0}, kB{1};

/** Claims to know everything, as a graph does that loops without a verdict connect. */
struct AllKnown : UncertaintyQuery {
  std::vector<std::optional<Matrix6d>> relativeCovariances(
      KeyNodeId, const std::vector<KeyNodeId>& to) const override {
    return std::vector<std::optional<Matrix6d>>(to.size(), Matrix6d::Identity());
  }
};

/** Two robots, each at its own origin, and a loop closure between them. */
PoseGraph strangers(Verdict verdict) {
  PoseGraph graph;
  for (const RobotId robot : {kA, kB})
    for (uint32_t i = 0; i < 2; ++i) {
      Node node;
      node.id = {robot, i};
      node.world_T_base = planarPose(3.0 * i, 0, 0);
      graph.addNode(node);
    }
  Edge loop;
  loop.type = EdgeType::kLoopClosure;
  loop.from = {kA, 0};
  loop.to = {kB, 0};
  loop.verdict = verdict;
  graph.addEdge(loop);
  return graph;
}

TEST(GraphGuess, OfStrangersIsWhatWasRecognizedWhateverWaitsForAVerdict) {
  const Pose3 recognized = planarPose(0, 0, 2);
  LoopClosureCandidate candidate{{kA, 0}, {kB, 1}, "test"};
  candidate.recognized = recognized;
  const auto guess = graphGuesses(strangers(Verdict::kPending), {candidate}, AllKnown{}).at(0);
  EXPECT_EQ(guess.target_T_source.matrix(), recognized.matrix());
  EXPECT_FALSE(guess.covariance) << "the graph cannot judge it";
}

TEST(GraphGuess, OfRobotsThatAreJoinedIsTheGraphs) {
  LoopClosureCandidate candidate{{kA, 0}, {kB, 1}, "test"};
  candidate.recognized = planarPose(0, 0, 2);
  const auto guess = graphGuesses(strangers(Verdict::kInlier), {candidate}, AllKnown{}).at(0);
  EXPECT_EQ(guess.target_T_source.matrix(), planarPose(3, 0, 0).matrix());
  EXPECT_TRUE(guess.covariance);
}

}  // namespace
}  // namespace lamp
