#include "lamp/loop_candidates/PlaceRecognition.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <set>

namespace lamp {
namespace {

constexpr RobotId kA{0}, kB{1}, kC{2};

/** A winding passage, 120 m long, with boulders along its walls, so that no two places are alike.
 */
struct Passage {
  explicit Passage(bool in_plane) : planar(in_plane) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> unit(0, 1);
    for (double s = -10; s < 130; s += 0.1)
      for (const double side : {-1.0, 1.0})
        for (int layer = 0; layer < (planar ? 1 : 6); ++layer)
          points.push_back(at(s, side * width(s, side)) +
                           Eigen::Vector3d(0, 0, planar ? 0 : 0.5 * layer - 1));
    for (int boulder = 0; boulder < 150; ++boulder) {
      const Eigen::Vector3d middle = at(140 * unit(random) - 10, 3 * (unit(random) - 0.5) * 2);
      for (int i = 0; i < 40; ++i)
        points.push_back(middle + Eigen::Vector3d(unit(random) - 0.5, unit(random) - 0.5,
                                                  planar ? 0 : unit(random) - 1));
    }
  }
  static double heading(double s) { return 0.9 * std::sin(s / 14) + 0.3 * std::sin(s / 5); }
  static double width(double s, double side) {
    return 3 + std::sin(0.31 * s + side) + 0.8 * std::sin(0.83 * s - 2 * side);
  }
  static Eigen::Vector3d at(double s, double aside) {
    Eigen::Vector3d p = Eigen::Vector3d::Zero();
    constexpr double kStep = 0.05;
    for (double t = 0; t < std::abs(s); t += kStep)
      p += (s < 0 ? -kStep : kStep) *
           Eigen::Vector3d(std::cos(heading(s < 0 ? -t : t)), std::sin(heading(s < 0 ? -t : t)), 0);
    return p + aside * Eigen::Vector3d(-std::sin(heading(s)), std::cos(heading(s)), 0);
  }
  /** A robot's pose: `back` drives towards smaller s. */
  static Pose3 poseAt(double s, double aside, bool back) {
    Pose3 pose = planarPose(0, 0, heading(s) + (back ? M_PI : 0));
    pose.translation() = at(s, aside);
    return pose;
  }
  KeyedScanPtr scanFrom(const Pose3& pose) const {
    auto scan = std::make_shared<Scan>();
    for (const Eigen::Vector3d& point : points) {
      const Eigen::Vector3d seen = pose.inverse() * point;
      if (seen.norm() < 15) scan->points.push_back(seen.cast<float>());
    }
    scan->sensor.assign(scan->points.size(), 0);
    scan->sensors.resize(1);
    return scan;
  }

  bool planar;
  std::vector<Eigen::Vector3d> points;
};

/** Key nodes of one robot through the passage, each robot in a frame of its own. */
void drive(const Passage& passage, RobotId robot, double from, double to, double aside,
           PoseGraph& graph, std::vector<KeyNodePacket>& packets,
           std::map<KeyNodeId, Pose3>& truth) {
  const bool back = to < from;
  const Pose3 start = Passage::poseAt(from, aside, back);
  uint32_t index = 0;
  for (double s = from; back ? s >= to : s <= to; s += back ? -2 : 2) {
    const Pose3 pose = Passage::poseAt(s, aside, back);
    KeyNodePacket packet;
    packet.id = {robot, index++};
    packet.planar = passage.planar;
    packet.odom_T_base = start.inverse() * pose;
    packet.scan = passage.scanFrom(pose);
    Node node;
    node.id = packet.id;
    node.planar = passage.planar;
    node.world_T_base = packet.odom_T_base;
    graph.addNode(node);
    truth[packet.id] = pose;
    packets.push_back(packet);
  }
}

/** What is proposed as the packets arrive, and when each robot has ended: one robot after another.
 */
std::vector<LoopClosureCandidate> proposals(const PoseGraph& graph,
                                            const std::vector<KeyNodePacket>& packets) {
  PlaceRecognition recognition;
  std::vector<LoopClosureCandidate> result;
  for (const KeyNodePacket& packet : packets) {
    recognition.add(packet);
    if (packet.id == graph.robotNodes(packet.id.robot).back()) recognition.end(packet.id.robot);
    for (const LoopClosureCandidate& c : recognition.propose(graph, packet.id)) result.push_back(c);
  }
  return result;
}

class PlaceRecognitionIn : public testing::TestWithParam<bool> {};
INSTANTIATE_TEST_SUITE_P(SpaceAndPlane, PlaceRecognitionIn, testing::Bool());

TEST_P(PlaceRecognitionIn, FindsPlacesAndHeadingsThatAnotherRobotPassedTheOtherWay) {
  const Passage passage(GetParam());
  PoseGraph graph;
  std::vector<KeyNodePacket> packets;
  std::map<KeyNodeId, Pose3> truth;
  drive(passage, kA, 0, 80, 0.4, graph, packets, truth);
  drive(passage, kB, 119, 41, -0.5, graph, packets, truth);
  std::set<KeyNodeId> right, turned;
  for (const LoopClosureCandidate& c : proposals(graph, packets)) {
    ASSERT_EQ(c.from.robot, kA);
    ASSERT_EQ(c.to.robot, kB);
    if ((truth[c.from].translation() - truth[c.to].translation()).norm() > 3) continue;
    right.insert(c.to);
    ASSERT_TRUE(c.recognized);
    const Pose3 error = c.recognized->inverse() * truth[c.from].inverse() * truth[c.to];
    if (rotationAngle(error) < 0.2) turned.insert(c.to);
  }
  size_t met = 0;
  for (const KeyNodeId b : graph.robotNodes(kB)) {
    const auto isNear = [&](KeyNodeId a) {
      return (truth[a].translation() - truth[b].translation()).norm() < 1.5;
    };
    const auto& others = graph.robotNodes(kA);
    met += std::any_of(others.begin(), others.end(), isNear);
  }
  ASSERT_GE(met, 15u);
  EXPECT_GE(right.size() * 10, met * 7) << right.size() << " of " << met;
  EXPECT_GE(turned.size() * 10, right.size() * 8) << turned.size() << " of " << right.size();
}

TEST(PlaceRecognition, WaitsUntilTheSurroundingsAreKnown) {
  const Passage passage(true);
  PoseGraph graph;
  std::vector<KeyNodePacket> packets;
  std::map<KeyNodeId, Pose3> truth;
  drive(passage, kA, 0, 60, 0, graph, packets, truth);
  const size_t of_a = packets.size();
  drive(passage, kB, 20, 60, 0, graph, packets, truth);
  PlaceRecognition recognition;
  for (size_t i = 0; i < of_a; ++i) recognition.add(packets[i]);
  for (size_t i = of_a; i < packets.size(); ++i) {
    recognition.add(packets[i]);
    for (const LoopClosureCandidate& c : recognition.propose(graph, packets[i].id))
      EXPECT_NEAR(packets[i].id.index - c.to.index, 5.5, 0.5) << "10 m ahead of it have been seen";
  }
  recognition.end(kB);
  size_t last = 0;
  for (const LoopClosureCandidate& c : recognition.propose(graph, packets.back().id))
    last += c.to.index + 5 > packets.back().id.index;
  EXPECT_GT(last, 0u) << "nothing more is to be seen";
}

TEST(PlaceRecognition, HasNothingToDoWhereAFrameIsShared) {
  const Passage passage(true);
  PoseGraph graph;
  std::vector<KeyNodePacket> packets;
  std::map<KeyNodeId, Pose3> truth;
  for (const RobotId robot : {kA, kB}) drive(passage, robot, 0, 60, 0, graph, packets, truth);
  EXPECT_FALSE(proposals(graph, packets).empty());
  for (const RobotId robot : {kA, kB}) {
    Edge prior;
    prior.type = EdgeType::kPrior;
    prior.from = prior.to = {robot, 0};
    graph.addEdge(prior);
  }
  EXPECT_TRUE(proposals(graph, packets).empty());
}

TEST(PlaceRecognition, RobotsInThePlaneAndInSpaceAreNotCompared) {
  PoseGraph graph;
  std::vector<KeyNodePacket> packets;
  std::map<KeyNodeId, Pose3> truth;
  drive(Passage(true), kA, 0, 40, 0, graph, packets, truth);
  drive(Passage(false), kB, 0, 40, 0, graph, packets, truth);
  EXPECT_TRUE(proposals(graph, packets).empty());
}

TEST(PlaceRecognition, OfManyRobotsThoseCountThatHaveSeenWhatIsMostAlike) {
  const Passage passage(true);
  PoseGraph graph;
  std::vector<KeyNodePacket> packets;
  std::map<KeyNodeId, Pose3> truth;
  drive(passage, kA, 0, 50, 0, graph, packets, truth);
  drive(passage, kB, 70, 119, 0, graph, packets, truth);
  drive(passage, kC, 10, 40, 0, graph, packets, truth);
  PlaceRecognition recognition;
  recognition.options.max_other_robots = 1;
  for (const KeyNodePacket& packet : packets) recognition.add(packet);
  for (const RobotId robot : graph.robots()) recognition.end(robot);
  size_t with_a = 0, all = 0;
  for (const LoopClosureCandidate& c : recognition.propose(graph, {kC, 0})) {
    with_a += c.from.robot == kA;
    ++all;
  }
  EXPECT_GE(with_a * 10, all * 9) << "B was elsewhere";
  EXPECT_GT(all, 10u);
}

}  // namespace
}  // namespace lamp
