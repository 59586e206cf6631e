// The files of a run folder, opened by other programs' readers.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <mrpt/graphs/CNetworkOfPoses.h>
#include <mrpt/maps/CSimplePointsMap.h>
#include <mrpt/obs/CRawlog.h>
#include <octomap/OcTree.h>

#include <cstring>
#include <set>
#include <sstream>

#include "Experiment.h"
#include "G2oFile.h"
#include "Measures.h"

namespace lamp::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

const std::string kRawlogEdit = "/usr/bin/rawlog-edit";

/** A finished run of two robots, whose world frame is the true one. */
class Outputs : public testing::Test {
 protected:
  explicit Outputs(const std::string& exporters = "") : world_(BoxWorld::building(7)) {
    a_ = record("A", {{3, 3}, {17, 3}, {17, 9}}, 1);
    b_ = record("B", {{17, 11}, {17, 3}, {10, 3}}, 2);
    const std::string starts =
        startSection("A", a_.truth.front().pose) + startSection("B", b_.truth.front().pose);
    const LampResult end = experiment_.run(
        {experiment_.file("two.ini", iniFor3d(exporters, starts)),
         experiment_.rawlog("A.rawlog", a_.objects), experiment_.rawlog("B.rawlog", b_.objects),
         "--set", "occupancy.resolution_m=0.1"});
    EXPECT_EQ(end.exit_code, 0) << end.err;
    EXPECT_EQ(run().summary()["components"].size(), 1u);
  }

  Recording record(const std::string& name, const std::vector<Eigen::Vector2d>& route,
                   unsigned seed) const {
    SyntheticRobot robot;
    robot.name = name;
    robot.route = route;
    robot.seed = seed;
    return robot.record3d(world_);
  }

  FinishedRun run() const { return experiment_.result(); }

  /** Poses of the key nodes by their id in graph files, from graph_ids.csv and the TUM files. */
  std::map<int, Pose3> keyNodesById() const {
    const CsvTable ids = CsvTable::fromFile(run().folder().graphIds());
    std::map<int, Pose3> poses;
    for (const auto& row : ids.rows) {
      const auto key_nodes = run().keyNodes(row[ids.column("robot")]);
      const size_t index = std::stoul(row[ids.column("index")]);
      poses[std::stoi(row[ids.column("id")])] = key_nodes.at(index).pose;
    }
    return poses;
  }

  const BoxWorld world_;
  Recording a_, b_;
  Experiment experiment_;
};

TEST_F(Outputs, G2oGraphIsWhatTheTrajectoriesSay) {
  const G2oFile graph = G2oFile::read(run().folder().graphG2o());
  const auto expected = keyNodesById();
  ASSERT_EQ(graph.vertices.size(), expected.size());
  for (const auto& [id, pose] : expected) {
    ASSERT_EQ(graph.vertices.count(id), 1u) << id;
    EXPECT_TRUE(graph.vertices.at(id).isApprox(pose, 1e-7)) << id;
  }
  EXPECT_EQ(expected.begin()->first, 0);
  EXPECT_EQ(static_cast<size_t>(expected.rbegin()->first) + 1, expected.size());
  EXPECT_EQ(graph.fixed, std::set<int>{0});

  const size_t odometry_edges = expected.size() - 2;
  EXPECT_EQ(graph.edges.size(), odometry_edges + inlierLoops(run().loops()).size());
  for (const G2oFile::Edge& edge : graph.edges) {
    const Pose3 error = edge.from_T_to.inverse() * graph.vertices.at(edge.from).inverse() *
                        graph.vertices.at(edge.to);
    Vector6d residual;
    residual << error.translation(), Eigen::Quaterniond(error.linear()).vec();
    EXPECT_GT(edge.information.ldlt().vectorD().minCoeff(), 0);
    EXPECT_LT(residual.dot(edge.information * residual), 40) << edge.from << " " << edge.to;
  }
}

TEST_F(Outputs, GraphsLoadInMrpt) {
  const auto expected = keyNodesById();
  const size_t edges = G2oFile::read(run().folder().graphG2o()).edges.size();
  for (const std::string& file : {run().folder().graphMrpt(), run().folder().graphG2o()}) {
    mrpt::graphs::CNetworkOfPoses3DInf graph;
    graph.loadFromTextFile(file, false);
    EXPECT_EQ(graph.edgeCount(), edges) << file;
    ASSERT_EQ(graph.nodes.size(), expected.size()) << file;
    for (const auto& [id, pose] : graph.nodes) {
      const auto matrix = pose.getHomogeneousMatrixVal<mrpt::math::CMatrixDouble44>();
      EXPECT_TRUE(matrix.asEigen().isApprox(expected.at(static_cast<int>(id)).matrix(), 1e-6))
          << file << " " << id;
    }
  }
}

class OctreeOutputs : public Outputs {
 protected:
  OctreeOutputs() : Outputs("OctoMap") {}
};

class CloudOutputs : public Outputs {
 protected:
  CloudOutputs() : Outputs("Ply, Pcd, Picture") {}
};

/** Shares of the leaves of a tree that are where they should be. */
struct TreeShares {
  size_t occupied = 0, free = 0;
  size_t ground = 0;  ///< occupied, and below the floor, where the world is solid
  double occupied_at_surface = 0, free_within_surface = 0;
};

TreeShares compare(octomap::OcTree& tree, const BoxWorld& world) {
  TreeShares shares;
  tree.expand();
  for (auto leaf = tree.begin_leafs(); leaf != tree.end_leafs(); ++leaf) {
    const Eigen::Vector3d center(leaf.getX(), leaf.getY(), leaf.getZ());
    if (tree.isNodeOccupied(*leaf) && center.z() < 0) {
      ++shares.ground;
    } else if (tree.isNodeOccupied(*leaf)) {
      ++shares.occupied;
      if (world.distanceToSurface(center) < 0.25) shares.occupied_at_surface += 1;
    } else {
      ++shares.free;
      if (world.isInside(center) && world.distanceToSurface(center) > 0.07)
        shares.free_within_surface += 1;
    }
  }
  shares.occupied_at_surface /= static_cast<double>(shares.occupied);
  shares.free_within_surface /= static_cast<double>(shares.free);
  return shares;
}

TEST_F(OctreeOutputs, OctreeIsOccupiedAtWallsAndFreeOnTheWay) {
  octomap::OcTree tree(run().folder().mapStem(0) + ".bt");
  EXPECT_DOUBLE_EQ(tree.getResolution(), 0.1);
  double x0, y0, z0, x1, y1, z1;
  tree.getMetricMin(x0, y0, z0);
  tree.getMetricMax(x1, y1, z1);
  EXPECT_NEAR(x1 - x0, 20, 1);
  EXPECT_NEAR(y1 - y0, 15, 1);
  EXPECT_NEAR(z1 - z0, 3, 0.5);

  for (const Recording* recording : {&a_, &b_})
    for (const StampedPose& pose : recording->truth) {
      const Eigen::Vector3d lidar = pose.pose * Eigen::Vector3d(0, 0, 0.3);
      const auto* node = tree.search(lidar.x(), lidar.y(), lidar.z());
      ASSERT_NE(node, nullptr) << "unknown where the robot was: " << lidar.transpose();
      EXPECT_FALSE(tree.isNodeOccupied(node)) << lidar.transpose();
    }
  EXPECT_EQ(tree.search(-5, -5, 1), nullptr) << "outside the building nothing is known";

  const TreeShares shares = compare(tree, world_);
  EXPECT_GT(shares.ground, 1000u) << "the robots drove on it";
  // Of the building's 20 m x 15 m x 3 m, in litres; and 800 m2 of surface, as much as there is.
  EXPECT_GT(shares.free, 400000u);
  EXPECT_GT(shares.occupied, 60000u);
  EXPECT_GT(shares.occupied_at_surface, 0.98);
  EXPECT_LT(shares.free_within_surface, 0.02);
}

TEST_F(OctreeOutputs, FullOctreeAgreesWithTheBinaryOne) {
  octomap::OcTree binary(run().folder().mapStem(0) + ".bt");
  const std::unique_ptr<octomap::AbstractOcTree> file(
      octomap::AbstractOcTree::read(run().folder().mapStem(0) + ".ot"));
  auto* full = dynamic_cast<octomap::OcTree*>(file.get());
  ASSERT_NE(full, nullptr);
  binary.expand();
  full->expand();
  EXPECT_EQ(full->getNumLeafNodes(), binary.getNumLeafNodes());
  std::set<float> values;
  for (auto leaf = full->begin_leafs(); leaf != full->end_leafs(); ++leaf) {
    values.insert(leaf->getLogOdds());
    const auto* same = binary.search(leaf.getKey());
    ASSERT_NE(same, nullptr);
    ASSERT_EQ(binary.isNodeOccupied(same), full->isNodeOccupied(*leaf));
  }
  EXPECT_GT(values.size(), 5u) << "graded occupancy, not only free and occupied";
}

TEST_F(CloudOutputs, PcdHoldsWhatItsHeaderSays) {
  const std::string pcd = readFile(run().folder().mapStem(0) + ".pcd");
  const size_t data = pcd.find("DATA binary\n");
  ASSERT_NE(data, std::string::npos);
  std::map<std::string, std::string> header;
  std::istringstream lines(pcd.substr(0, data));
  for (std::string line; std::getline(lines, line);)
    if (line[0] != '#') header[line.substr(0, line.find(' '))] = line.substr(line.find(' ') + 1);
  EXPECT_THAT(header["FIELDS"], testing::StartsWith("x y z rgb"));
  EXPECT_EQ(header["HEIGHT"], "1");
  EXPECT_EQ(header["WIDTH"], header["POINTS"]);
  size_t stride = 0;
  std::istringstream sizes(header["SIZE"]);
  for (size_t size; sizes >> size;) stride += size;
  const size_t points = std::stoul(header["POINTS"]);
  EXPECT_GT(points, 5000u);
  const size_t start = data + std::string("DATA binary\n").size();
  ASSERT_EQ(pcd.size() - start, points * stride);

  size_t near_surface = 0;
  for (size_t i = 0; i < points; ++i) {
    Eigen::Vector3f point;
    std::memcpy(point.data(), pcd.data() + start + i * stride, sizeof(float) * 3);
    ASSERT_TRUE(point.allFinite());
    if (world_.distanceToSurface(point.cast<double>()) < 0.25) ++near_surface;
  }
  EXPECT_GT(static_cast<double>(near_surface), 0.98 * static_cast<double>(points));
}

TEST_F(CloudOutputs, PlyLoadsInMrpt) {
  mrpt::maps::CSimplePointsMap cloud;
  ASSERT_TRUE(cloud.loadFromPlyFile(run().folder().mapStem(0) + ".ply"));
  EXPECT_GT(cloud.size(), 5000u);
  const auto box = cloud.boundingBox();
  EXPECT_NEAR(box.max.x - box.min.x, 20, 1);
  EXPECT_NEAR(box.max.y - box.min.y, 15, 1);
  EXPECT_NEAR(box.max.z - box.min.z, 3, 0.5);
}

TEST_F(Outputs, KeyedScansLoadInMrpt) {
  mrpt::obs::CRawlog rawlog;
  ASSERT_TRUE(rawlog.loadFromRawLogFile(run().folder().keyNodes("A")));
  const auto key_nodes = run().keyNodes("A");
  ASSERT_EQ(rawlog.size(), 2 * key_nodes.size());
  for (size_t i = 0; i < key_nodes.size(); ++i) {
    const auto odometry = rawlog.asObservation<mrpt::obs::CObservationRobotPose>(2 * i);
    const auto cloud = rawlog.asObservation<mrpt::obs::CObservationPointCloud>(2 * i + 1);
    ASSERT_TRUE(odometry && cloud);
    EXPECT_EQ(odometry->sensorLabel, "A/odometry");
    EXPECT_EQ(cloud->sensorLabel, "A/lidar");
    EXPECT_NEAR(mrpt::Clock::toDouble(cloud->timestamp), key_nodes[i].stamp, 1e-5);
    EXPECT_GT(cloud->pointcloud->size(), 500u);
    EXPECT_NEAR(cloud->sensorPose.z(), 0.3, 1e-9);
  }
}

TEST_F(Outputs, KeyedScansOpenInRawlogEdit) {
  if (!std::filesystem::exists(kRawlogEdit)) GTEST_SKIP() << kRawlogEdit << " is not installed";
  const std::string info = experiment_.path("info.txt");
  const std::string command =
      kRawlogEdit + " -i " + run().folder().keyNodes("B") + " --info > " + info + " 2>&1";
  EXPECT_EQ(std::system(command.c_str()), 0);
  EXPECT_THAT(readFile(info), AllOf(HasSubstr("B/odometry"), HasSubstr("B/lidar")));
}

TEST_F(Outputs, KeyedScansCanBeMappedAgain) {
  const LampResult end =
      experiment_.run({experiment_.file("again.ini", iniFor3d()), run().folder().keyNodes("A"),
                       "--set", "frontend.keyed=true"},
                      "again");
  ASSERT_EQ(end.exit_code, 0) << end.err;
  const auto first = run().keyNodes("A"), again = experiment_.result("again").keyNodes("A");
  ASSERT_EQ(again.size(), first.size());
  for (size_t i = 0; i < first.size(); ++i) EXPECT_EQ(again[i].stamp, first[i].stamp);
  EXPECT_LT(ateFromFirst(again, a_.truth), 0.3);
}

TEST_F(Outputs, LedgerAccountsForEveryLoop) {
  const CsvTable loops = run().loops();
  const auto summary = run().summary();
  EXPECT_EQ(loops.rows.size(), summary["loops"]["attempts"]);
  EXPECT_EQ(inlierLoops(loops).size(), summary["loops"]["inliers"]);
  size_t verified = 0;
  for (const auto& row : loops.rows) {
    const bool accepted = row[loops.column("stage")] == "verified";
    verified += accepted ? 1 : 0;
    EXPECT_EQ(row[loops.column("reason")].empty(), accepted);
    EXPECT_EQ(row[loops.column("verdict")] == "refused", !accepted);
  }
  EXPECT_EQ(verified, summary["loops"]["verified"]);
}

TEST(PartialOutputs, AMapThatCannotBeWrittenTakesNothingElseWithIt) {
  const Experiment experiment;
  SyntheticRobot robot;
  robot.name = "A";
  robot.route = shortRoute();
  const LampResult end =
      experiment.run({experiment.file("one.ini", iniFor3d("Ply, Pcd, OctoMap")),
                      experiment.rawlog("A.rawlog", robot.record3d(BoxWorld::building(7)).objects),
                      "--set", "lamp::Ply.voxel_m=1e-9"});
  EXPECT_EQ(end.exit_code, 1);
  EXPECT_THAT(end.err, AllOf(HasSubstr("not everything could be written"), HasSubstr("Ply: ")));
  EXPECT_THAT(end.out, HasSubstr("map 1 of 1"));
  const FinishedRun run = experiment.result();
  for (const char* file : {"maps/map.pcd", "maps/map.bt", "maps/map.ot", "timings.json"})
    EXPECT_TRUE(run.has(file)) << file;
  EXPECT_FALSE(run.has("maps/map.ply"));
  EXPECT_EQ(run.summary()["not_written"].size(), 1u);
}

TEST(MapsOnTheWay, AreWrittenAndLeaveTheLastOnesAsTheyWouldBe) {
  const Experiment experiment;
  SyntheticRobot robot;
  robot.name = "A";
  robot.route = shortRoute();
  const std::string ini = experiment.file("one.ini", iniFor3d("OctoMap")),
                    rawlog = experiment.rawlog("A.rawlog",
                                               robot.record3d(BoxWorld::building(7)).objects);
  for (const char* every : {"0", "2"}) {
    const LampResult end = experiment.run(
        {ini, rawlog, "--set", std::string("run.maps_every_key_nodes=") + every}, every);
    ASSERT_EQ(end.exit_code, 0) << end.err;
  }
  const FinishedRun at_end = experiment.result("0"), on_the_way = experiment.result("2");
  const auto writes = [](const FinishedRun& run) {
    return nlohmann::json::parse(
               readFile(run.folder().timings()))["stages"]["maps.OctoMap"]["calls"]
        .get<size_t>();
  };
  EXPECT_EQ(writes(at_end), 1u);
  EXPECT_EQ(writes(on_the_way), 1 + on_the_way.keyNodes("A").size() / 2);
  for (const char* extension : {".bt", ".ot"})
    EXPECT_EQ(readFile(at_end.folder().mapStem(0) + extension),
              readFile(on_the_way.folder().mapStem(0) + extension));
}

TEST_F(CloudOutputs, PictureAndTimingsAreThere) {
  EXPECT_THAT(readFile(run().folder().mapStem(0) + ".png"), testing::StartsWith("\x89PNG"));
  const auto timings = nlohmann::json::parse(readFile(run().folder().timings()));
  EXPECT_GT(timings["peak_memory_mb"], 1);
  EXPECT_TRUE(timings["stages"].contains("run"));
}

}  // namespace
}  // namespace lamp::test
