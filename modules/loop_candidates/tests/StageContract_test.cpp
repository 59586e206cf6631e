// What every candidate generator must hold to, whoever wrote it.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>
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

/** What a key node sees of a common landscape, in which each place looks different. */
KeyedScanPtr scanAt(const Pose3& world_T_base) {
  auto scan = std::make_shared<Scan>();
  scan->sensors.resize(1);
  for (int i = 0; i < 4000; ++i) {
    const double t = 0.01 * i;
    const Eigen::Vector3d p(30 * std::sin(1.7 * t), 25 * std::cos(2.3 * t + 0.4), 0);
    const Eigen::Vector3d seen = world_T_base.inverse() * p;
    if (seen.norm() > 20) continue;
    scan->points.push_back(seen.cast<float>());
    scan->sensor.push_back(0);
  }
  return scan;
}

/** The packets that a graph's key nodes came with. */
std::vector<KeyNodePacket> packetsOf(const PoseGraph& graph) {
  std::vector<KeyNodePacket> packets;
  for (const Node& node : graph.nodes()) {
    KeyNodePacket packet;
    packet.id = node.id;
    packet.planar = true;
    packet.odom_T_base = node.world_T_base;
    packet.scan = scanAt(node.world_T_base);
    packets.push_back(packet);
  }
  return packets;
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
  /** Told of the key nodes of the team. */
  std::shared_ptr<CandidateGenerator> make() const {
    static const std::vector<KeyNodePacket> packets = packetsOf(team(true));
    const auto generator = makeDefault<CandidateGenerator>(GetParam());
    for (const KeyNodePacket& packet : packets) generator->add(packet);
    for (const RobotId robot : {kA, kB}) generator->end(robot);
    return generator;
  }
  /** Candidates of each key node of a graph in turn. */
  std::vector<LoopClosureCandidate> all(const PoseGraph& graph) const {
    const auto fresh = make();
    std::vector<LoopClosureCandidate> result;
    for (const Node& node : graph.nodes())
      for (const LoopClosureCandidate& c : fresh->propose(graph, node.id)) result.push_back(c);
    return result;
  }
};
INSTANTIATE_TEST_SUITE_P(All, AnyCandidateGenerator, testing::ValuesIn(generators()), testName);

TEST_P(AnyCandidateGenerator, ProposesPairsOfTheCurrentRobotOnce) {
  size_t proposed = 0;
  for (const bool common_frame : {true, false}) {
    const PoseGraph graph = team(common_frame);
    const auto generator = make();
    for (const Node& node : graph.nodes()) {
      std::set<std::pair<KeyNodeId, KeyNodeId>> pairs;
      for (const LoopClosureCandidate& c : generator->propose(graph, node.id)) {
        ++proposed;
        ASSERT_TRUE(graph.contains(c.from) && graph.contains(c.to));
        ASSERT_NE(c.from, c.to);
        EXPECT_TRUE(c.from.robot == node.id.robot || c.to.robot == node.id.robot);
        EXPECT_LT(graph.place(c.from), graph.place(c.to)) << "the older one comes first";
        EXPECT_TRUE(pairs.insert({c.from, c.to}).second) << "proposed twice";
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
  EXPECT_EQ(pairs(all(graph)), pairs(all(moved)));
}

TEST_P(AnyCandidateGenerator, SaysTheSameForTheSameKeyNodesAndKeepsNothingOfOtherGraphs) {
  const PoseGraph graph = team(true);
  const PoseGraph other = team(false);
  const auto used = make();
  for (const Node& node : graph.nodes()) {
    used->propose(other, node.id);
    EXPECT_EQ(pairs(used->propose(graph, node.id)), pairs(make()->propose(graph, node.id)));
  }
  EXPECT_EQ(pairs(all(other)), pairs(all(other)));
}

TEST_P(AnyCandidateGenerator, HasNothingForTheFirstKeyNode) {
  PoseGraph graph;
  addLaps(graph, kA, 1, 0, true);
  const auto generator = makeDefault<CandidateGenerator>(GetParam());
  generator->add(packetsOf(graph).front());
  EXPECT_TRUE(generator->propose(graph, {kA, 0}).empty());
  generator->end(kA);
  EXPECT_TRUE(generator->propose(graph, {kA, 0}).empty());
}

TEST_P(AnyCandidateGenerator, SurvivesEstimatesThatAreNoNumbers) {
  for (const bool common_frame : {true, false}) {
    PoseGraph graph = team(common_frame);
    const KeyNodeId broken{kB, kLap};
    graph.node(broken).world_T_base.translation().x() = std::numeric_limits<double>::quiet_NaN();
    for (const LoopClosureCandidate& c : all(graph))
      if (common_frame) {
        EXPECT_TRUE(c.from != broken && c.to != broken) << "nothing is near to nowhere";
      }
  }
}

TEST_P(AnyCandidateGenerator, SurvivesScansThatShowNothing) {
  const PoseGraph graph = team(false);
  std::vector<KeyNodePacket> packets = packetsOf(graph);
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  for (size_t i = 0; i < packets.size(); ++i) {
    auto scan = std::make_shared<Scan>();
    if (i % 3 == 1) scan->points = {{kNan, kNan, kNan}};
    if (i % 3 == 2) scan->points = {{1, 0, 0}};
    scan->sensor.assign(scan->points.size(), 0);
    packets[i].scan = scan;
  }
  const auto generator = makeDefault<CandidateGenerator>(GetParam());
  for (const KeyNodePacket& packet : packets) {
    generator->add(packet);
    for (const LoopClosureCandidate& c : generator->propose(graph, packet.id))
      EXPECT_TRUE(graph.contains(c.from) && graph.contains(c.to));
  }
  for (const RobotId robot : {kA, kB}) generator->end(robot);
}

}  // namespace
}  // namespace lamp
