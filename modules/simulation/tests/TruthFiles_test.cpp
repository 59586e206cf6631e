#include "lamp/simulation/TruthFiles.h"

#include <gtest/gtest.h>

#include <cstring>
#include <nlohmann/json.hpp>
#include <random>

#include "MeshTools.h"
#include "SmallMission.h"
#include "TemporaryFolder.h"
#include "lamp/core/Csv.h"
#include "lamp/core/Files.h"

namespace lamp::simulation {
namespace {

using namespace test;

/** A file that goes with the test. */
class TruthFiles : public testing::Test {
 protected:
  const TemporaryFolder folder_;
  const std::string path_ = folder_ / "truth";
};

struct Sample {
  Eigen::Vector3f point, normal;
  bool seen;
};

std::vector<Sample> readPly(const std::string& path) {
  const std::string text = readTextFile(path), end = "end_header\n";
  EXPECT_EQ(text.rfind("ply\nformat binary_little_endian 1.0\n", 0), 0u);
  const size_t body = text.find(end) + end.size();
  const std::string element = "element vertex ";
  const size_t count = std::stoul(text.substr(text.find(element) + element.size(), 12));
  EXPECT_EQ(text.size() - body, count * (6 * sizeof(float) + 1)) << "as large as its header says";
  std::vector<Sample> samples(count);
  const char* at = text.data() + body;
  for (Sample& sample : samples) {
    std::memcpy(sample.point.data(), at, 12);
    std::memcpy(sample.normal.data(), at + 12, 12);
    sample.seen = at[24] != 0;
    at += 25;
  }
  return samples;
}

/** A large triangle at z = 1, one smaller than the spacing at z = 2, and one without area. */
Mesh threeTriangles() {
  Mesh mesh;
  mesh.vertices = {{0, 0, 1}, {2, 0, 1}, {0, 1, 1}, {0, 0, 2}, {0.03f, 0, 2}, {0, 0.03f, 2}};
  mesh.triangles = {{0, 1, 2}, {3, 5, 4}, {0, 0, 1}};
  mesh.materials.assign(3, Material::kRock);
  return mesh;
}

TEST_F(TruthFiles, TheMapSamplesEachTriangle) {
  SeenTriangles seen(3);
  seen[0] = true;
  const size_t count = writeTruthMap(path_, threeTriangles(), seen, 0.1);
  const auto samples = readPly(path_);
  EXPECT_EQ(samples.size(), count);
  size_t large = 0, small = 0;
  for (const Sample& sample : samples) {
    const bool is_large = sample.point.z() == 1;
    ++(is_large ? large : small);
    EXPECT_EQ(sample.seen, is_large);
    EXPECT_EQ(sample.normal, Eigen::Vector3f(0, 0, is_large ? 1 : -1));
    EXPECT_LE(0.5f * sample.point.x() + sample.point.y(), 1) << "within the triangle";
    EXPECT_GE(sample.point.head<2>().minCoeff(), 0);
  }
  EXPECT_EQ(small, 1u);
  EXPECT_GE(large, 100u) << "of 1 m² at 0.1 m";
}

TEST_F(TruthFiles, NoPointOfTheSurfaceIsFartherFromASampleThanTheSpacing) {
  writeTruthMap(path_, threeTriangles(), SeenTriangles(3), 0.1);
  const auto samples = readPly(path_);
  std::mt19937 random(1);
  std::uniform_real_distribution<float> uniform(0, 1);
  for (int i = 0; i < 500; ++i) {
    float s = uniform(random), t = uniform(random);
    if (s + t > 1) s = 1 - s, t = 1 - t;
    const Eigen::Vector3f p(2 * s, t, 1);
    float nearest = 1e9f;
    for (const Sample& sample : samples) nearest = std::min(nearest, (sample.point - p).norm());
    EXPECT_LT(nearest, 0.1f);
  }
}

TEST_F(TruthFiles, TheMapOfAWorldIsPartlySeen) {
  const SmallMission& small = SmallMission::shared();
  writeTruthMap(path_, small.world.mesh, small.seen, 0.5);
  size_t seen = 0, count = 0;
  for (const Sample& sample : readPly(path_)) {
    seen += sample.seen;
    ++count;
    EXPECT_NEAR(sample.normal.norm(), 1, 1e-4);
  }
  EXPECT_GT(seen, count / 10);
  EXPECT_LT(seen, count);
}

TEST_F(TruthFiles, AFolderThatIsNotThereIsAFault) {
  EXPECT_THROW(writeTruthMap("/not/there/map.ply", threeTriangles(), SeenTriangles(3), 0.1),
               std::runtime_error);
}

TEST_F(TruthFiles, TrajectoriesHoldTheTruthAtEachScan) {
  const MissionRobot& robot = SmallMission::shared().mission.robots[0];
  writeTextFile(path_, truthTum(robot));
  const auto poses = readTum(path_);
  const auto stamps = robot.scanStamps();
  ASSERT_EQ(poses.size(), stamps.size());
  for (size_t i = 0; i < poses.size(); i += 17) {
    EXPECT_NEAR(poses[i].stamp, stamps[i], 1e-6);
    EXPECT_LT(logSE3(poses[i].pose.inverse() * robot.truth.at(stamps[i])).norm(), 1e-5);
  }
}

TEST_F(TruthFiles, ArrivalsAreNotBeforeTheirStamps) {
  const MissionRobot& robot = SmallMission::shared().mission.robots[1];
  const CsvTable table = CsvTable::fromText(arrivalsCsv(robot), "arrivals");
  EXPECT_EQ(table.columns, (std::vector<std::string>{"stamp", "arrival"}));
  ASSERT_EQ(table.rows.size(), robot.key_nodes.size());
  for (size_t i = 0; i < table.rows.size(); ++i) {
    EXPECT_NEAR(std::stod(table.rows[i][0]), robot.stampOf(i), 1e-6);
    EXPECT_GE(std::stod(table.rows[i][1]), std::stod(table.rows[i][0]));
  }
}

TEST_F(TruthFiles, LoopPairsAreWrittenAsTheyAre) {
  const SmallMission& small = SmallMission::shared();
  const auto pairs = findLoopPairs(small.mission, small.world.layout, small.scans, 20, 5);
  const CsvTable table = CsvTable::fromText(loopPairsCsv(pairs, small.mission), "pairs");
  ASSERT_EQ(table.rows.size(), pairs.size());
  for (size_t i = 0; i < pairs.size(); ++i) {
    const auto cell = [&](const char* column) { return table.rows[i][table.column(column)]; };
    const auto number = [&](const char* column) { return std::stod(cell(column)); };
    EXPECT_EQ(cell("from"), small.mission.robots[pairs[i].from.robot.value].name + ":" +
                                std::to_string(pairs[i].from.index));
    EXPECT_EQ(cell("pair"), pairs[i].same_place ? "true" : "false");
    EXPECT_NEAR(number("to_stamp"), pairs[i].to_stamp, 1e-6);
    EXPECT_NEAR(number("overlap"), pairs[i].overlap, 1e-4);
    Pose3 read = Pose3::Identity();
    read.translation() << number("x"), number("y"), number("z");
    read.linear() =
        Eigen::Quaterniond(number("qw"), number("qx"), number("qy"), number("qz")).matrix();
    EXPECT_LT(logSE3(read.inverse() * pairs[i].from_T_to).norm(), 1e-7);
  }
}

TEST_F(TruthFiles, TheWorldIsDescribedInFull) {
  const SmallMission& small = SmallMission::shared();
  const auto json = nlohmann::json::parse(worldJson(small.world, small.mission, "demo", 3));
  EXPECT_EQ(json["world"], "demo");
  EXPECT_EQ(json["seed"], 3);
  ASSERT_EQ(json["gate"]["plates_m"].size(), 3u);
  for (size_t i = 0; i < 3; ++i)
    for (int axis = 0; axis < 3; ++axis)
      EXPECT_EQ(json["gate"]["plates_m"][i][static_cast<size_t>(axis)],
                small.world.plates[i][axis]);
  EXPECT_EQ(json["artifacts"].size(), small.world.artifacts.size());
  EXPECT_EQ(json["beacons"].size(), small.mission.beacons.size());
  ASSERT_EQ(json["robots"].size(), 2u);
  EXPECT_EQ(json["robots"][1]["name"], "bravo");
  EXPECT_EQ(json["robots"][1]["key_nodes"], small.mission.robots[1].key_nodes.size());
}

TEST_F(TruthFiles, TheExperimentFileNamesTheRobots) {
  const World& world = SmallMission::shared().world;
  const Mission& mission = SmallMission::shared().mission;
  Faults faults;
  const Ini ini = Ini::fromText(slamIni(world, mission, true), "lamp.ini", faults);
  EXPECT_TRUE(faults.empty());
  ASSERT_NE(ini.find("frontend"), nullptr);
  EXPECT_EQ(ini.find("frontend")->find("keyed")->value, "true");
  ASSERT_NE(ini.find("gate"), nullptr);
  std::istringstream plates(ini.find("gate")->find("plates")->value.substr(1));
  for (const Eigen::Vector3d& plate : world.plates)
    for (int axis = 0; axis < 3; ++axis) {
      double number = 0;
      plates >> number;
      EXPECT_NEAR(number, plate[axis], 1e-6);
    }
  for (const MissionRobot& robot : mission.robots) {
    const Ini::Section* section = ini.find("robot." + robot.name);
    ASSERT_NE(section, nullptr);
    EXPECT_EQ(section->find("rawlog")->value, robot.name + ".rawlog");
    EXPECT_EQ(section->find("arrivals")->value, robot.name + ".arrivals.csv");
    Vector6d pose;
    std::istringstream numbers(section->find("start_pose")->value.substr(1));
    for (double& number : pose) numbers >> number;
    pose.tail<3>() *= M_PI / 180;
    const Pose3 start = robot.truth.at(robot.truth.begin());
    EXPECT_LT(logSE3(start.inverse() * poseFromYawPitchRoll(pose)).norm(), 1e-5);
  }
  EXPECT_EQ(Ini::fromText(slamIni(world, mission, false), "lamp.ini", faults).find("frontend"),
            nullptr);
}

}  // namespace
}  // namespace lamp::simulation
