#include "lamp/base_station/ExtraEdges.h"

#include <gmock/gmock.h>

#include "TestTeam.h"
#include "lamp/base_station/LandmarkTable.h"
#include "lamp/core/Trajectory.h"

namespace lamp {
namespace {

using namespace test;

const Eigen::Vector3d kArtifact(10, 3, 0), kAnchor(12, 11, 2), kAntenna(0.2, 0, 0.5),
    kBeacon(-0.3, 0.1, 0.4);
constexpr int kAnchorNumber = 5, kRobotNumber = 6;

/** Adds what each robot measures at its key nodes, truly, to a team's packets. */
void equip(Team& team) {
  for (RobotDrive& drive : team.drives)
    for (size_t i = 0; i < drive.packets.size(); ++i) {
      KeyNodePacket& packet = drive.packets[i];
      const Pose3& truth = drive.truth[i].pose;
      const Eigen::Vector3d seen = truth.inverse() * kArtifact;
      if (seen.norm() < 5)
        packet.extras.sightings.push_back(
            {packet.stamp, "artifact_1", Eigen::Vector3d::Zero(), seen, 0.02, 0.1});
      packet.extras.ranges.push_back(
          {packet.stamp, kAnchorNumber, kAntenna, (truth * kAntenna - kAnchor).norm(), 0.1});
      packet.extras.gravity = GravityReading{packet.stamp, Eigen::Vector3d::UnitZ(), 0.02};
    }
}

std::string beaconIni() {
  return "[robot.a]\nbeacon_id = 4\n[robot.b]\nbeacon_id = 6\nbeacon_position = [-0.3 0.1 0.4]\n"
         "[beacon.gate]\nid = 5\nposition = [12 11 2]\n";
}

size_t count(const PoseGraph& graph, EdgeType type) {
  return static_cast<size_t>(std::count_if(graph.edges().begin(), graph.edges().end(),
                                           [&](const Edge& edge) { return edge.type == type; }));
}

TEST(ExtraEdges, LandmarksAndAnchorsTieTheMap) {
  for (const bool planar : {true, false}) {
    Team team(planar);
    equip(team);
    Station station("[pipeline]\ncandidates =\nexporters =\n" + beaconIni());
    team.sendTo(station.base);
    const PoseGraph& graph = station.base.graph();
    EXPECT_EQ(count(graph, EdgeType::kGravity), graph.nodes().size());
    EXPECT_EQ(count(graph, EdgeType::kRange), graph.nodes().size());
    for (const Edge& edge : graph.edges()) EXPECT_EQ(edge.verdict, Verdict::kInlier);

    ASSERT_TRUE(graph.findLandmark("artifact_1") && graph.findLandmark("gate"));
    const Landmark& artifact = graph.landmarks()[*graph.findLandmark("artifact_1")];
    EXPECT_TRUE(artifact.placed);
    EXPECT_LT((artifact.world_p - kArtifact).norm(), 0.3);
    EXPECT_EQ(graph.landmarks()[*graph.findLandmark("gate")].world_p, kAnchor);
    for (const RobotDrive& drive : team.drives) {
      const RobotId robot = drive.end.robot;
      EXPECT_LT(rmse(drive.truth, keyNodeTrajectory(station.base.graph(), robot)),
                0.5 * rmse(drive.all_scans, station.base.tracks().odometryTrajectory(robot)));
    }

    RobotTable robots;
    robots.add("a");
    robots.add("b");
    const CsvTable table = landmarkTable(graph, robots);
    ASSERT_EQ(table.rows.size(), 2u);
    for (const auto& row : table.rows) {
      EXPECT_EQ(row.size(), table.columns.size());
      EXPECT_EQ(row.back(), "a b");
    }
  }
}

/** The distance is measured between two scans of the other robot, which may report later. */
TEST(ExtraEdges, ADistanceBetweenRobotsWaitsForTheOtherOne) {
  const Team team(false);
  const SlamConfig config = configFrom(beaconIni());
  ExtraEdges extra(config.robots, config.beacons);
  PoseGraph graph;
  std::map<KeyNodeId, KeyNodePacket> packets;
  const auto receive = [&](const KeyNodePacket& packet, const KeyNodeExtras& extras) {
    Node node;
    node.id = packet.id;
    node.stamp = packet.stamp;
    graph.addNode(node);
    packets[packet.id] = packet;
    return extra.add(packet.id, extras, packets, graph);
  };
  const auto& a = team.drives[0].packets;
  const auto& b = team.drives[1].packets;
  const double stamp = 0.5 * (b[1].stamp + b[2].stamp) + 0.1;
  KeyNodeExtras extras;
  extras.ranges = {{stamp, kRobotNumber, kAntenna, 7.0, 0.1},
                   {stamp, 4, kAntenna, 1.0, 0.1}};  // its own beacon
  EXPECT_FALSE(receive(a[0], extras));
  EXPECT_FALSE(receive(b[0], {}));
  EXPECT_FALSE(receive(b[1], {}));
  EXPECT_TRUE(receive(b[2], {}));
  ASSERT_EQ(graph.edges().size(), 1u);
  const Edge& edge = graph.edges()[0];
  EXPECT_EQ(edge.type, EdgeType::kRobotRange);
  EXPECT_EQ(edge.from, a[0].id);
  EXPECT_EQ(edge.to, b[2].id);
  EXPECT_EQ(edge.from_p_sensor, kAntenna);
  std::vector<StampedPose> path = b[2].passed_scans;
  path.insert(path.begin(), {b[1].stamp, b[1].odom_T_base});
  const Pose3 then = TrajectoryInterpolator(path).at(stamp);
  EXPECT_LT((edge.to_p_sensor - b[2].odom_T_base.inverse() * (then * kBeacon)).norm(), 1e-9);
  EXPECT_TRUE(receive(a[1], extras)) << "the other robot has been there already";
}

TEST(ExtraEdges, BeaconsMustHaveNumbersOfTheirOwn) {
  for (const char* ini :
       {"[beacon.gate]\nposition = [1 2 3]\n", "[beacon.a]\nid = 3\n[beacon.b]\nid = 3\n",
        "[robot.a]\nbeacon_id = 3\n[beacon.b]\nid = 3\n", "[beacon.a]\nid = 3\nposition = [1 2]\n",
        "[robot.a]\nbeacon_id = 3\n[robot.b]\nbeacon_id = 3\n"})
    EXPECT_THROW(configFrom(ini), ConfigError) << ini;
  const SlamConfig config = configFrom(beaconIni());
  EXPECT_THAT(config.text(), testing::HasSubstr("[beacon.gate]"));
}

}  // namespace
}  // namespace lamp
