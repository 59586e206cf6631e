// lamp-register, through the real program, on clouds with a known pose between them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <random>

#include "BoxWorld.h"
#include "Experiment.h"
#include "lamp/core/Files.h"

namespace lamp::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr int kFailed = 1, kWrongUse = 2;
using Points = std::vector<Eigen::Vector3d>;

/** What a lidar with 32 rings sees from a pose, in its own frame. */
Points scan(const BoxWorld& world, const Pose3& world_T_lidar, unsigned seed) {
  constexpr int kRings = 32, kColumns = 360;
  std::mt19937 random(seed);
  std::normal_distribution<double> noise(0, 0.01);
  Points points;
  for (int ring = 0; ring < kRings; ++ring)
    for (int column = 0; column < kColumns; ++column) {
      const double up = (ring - 16) * M_PI / 180 * 2, around = column * M_PI / 180;
      const Eigen::Vector3d ray(std::cos(up) * std::cos(around), std::cos(up) * std::sin(around),
                                std::sin(up));
      const double range =
          world.range(world_T_lidar.translation(), world_T_lidar.linear() * ray) + noise(random);
      if (std::isfinite(range)) points.push_back(range * ray);
    }
  return points;
}

std::string plyText(const Points& points, const std::string& last = "") {
  std::string text = "ply\nformat ascii 1.0\nelement vertex " +
                     std::to_string(points.size() + (last.empty() ? 0 : 1)) +
                     "\nproperty float x\nproperty float y\nproperty float z\nend_header\n";
  for (const auto& p : points)
    text +=
        std::to_string(p.x()) + " " + std::to_string(p.y()) + " " + std::to_string(p.z()) + "\n";
  return text + last;
}

Pose3 at(double x, double y, double yaw) {
  Pose3 pose = planarPose(x, y, yaw);
  pose.translation().z() = 1;
  return pose;
}

/** Two scans of a building, 2.5 m and 120 degrees apart. */
class RegisterPair : public testing::Test {
 protected:
  nlohmann::json json() const {
    return nlohmann::json::parse(readTextFile(experiment_.path("result.json")));
  }
  LampResult run(std::vector<std::string> arguments) const {
    arguments.insert(arguments.end(), {"--json", experiment_.path("result.json")});
    return runRegister(arguments);
  }
  std::string file(const std::string& name, const std::string& text) const {
    return experiment_.file(name, text);
  }

  const BoxWorld world_ = BoxWorld::building(3);
  const Pose3 world_T_target_ = at(4, 4, 0.3), world_T_source_ = at(4.5, 6.5, 2.4);
  const Experiment experiment_;
  const std::string target_ = file("target.ply", plyText(scan(world_, world_T_target_, 1)));
  const std::string source_ = file("source.ply", plyText(scan(world_, world_T_source_, 2)));
};

TEST_F(RegisterPair, FindsThePoseWithoutAGuess) {
  const LampResult end = run({source_, target_, "--picture", experiment_.path("pair.png")});
  ASSERT_EQ(end.exit_code, 0) << end.err;
  EXPECT_THAT(end.err, IsEmpty());
  const auto result = json();
  EXPECT_TRUE(result["accepted"]) << end.out;
  EXPECT_EQ(result["stage"], "verified");
  EXPECT_EQ(result["reason"], "");
  ASSERT_EQ(result["target_T_source"].size(), 16u);
  Pose3 found;
  for (int i = 0; i < 16; ++i) found.matrix()(i / 4, i % 4) = result["target_T_source"][i];
  const Pose3 error = found.inverse() * world_T_target_.inverse() * world_T_source_;
  EXPECT_LT(error.translation().norm(), 0.05);
  EXPECT_LT(rotationAngle(error), 0.01);
  EXPECT_THAT(readTextFile(experiment_.path("pair.png")), HasSubstr("PNG"));
}

TEST_F(RegisterPair, SaysWhatLedToTheVerdict) {
  const LampResult end = run({source_, target_});
  ASSERT_EQ(end.exit_code, 0) << end.err;
  const auto result = json();
  EXPECT_EQ(result["information"].size(), 36u);
  EXPECT_TRUE(result["unobserved"].is_array());
  EXPECT_GE(result["scores"]["overlap"]["value"], 0.35);
  EXPECT_EQ(result["scores"]["overlap"]["threshold"], 0.35);
  ASSERT_FALSE(result["hypotheses"].empty());
  EXPECT_EQ(result["hypotheses"][0]["aligner"], "Teaser");
  EXPECT_GE(result["hypotheses"][0]["inliers"], 8);
  for (const char* part : {"prepare_source", "prepare_target", "align_refine_verify"})
    EXPECT_GT(result["timings_s"][part], 0);
  // More than the front end lets through, less than a tenth off its target.
  EXPECT_GT(result["source"]["points"], 3300);
  EXPECT_NEAR(result["source"]["used"].get<double>(), 3000, 400);
  EXPECT_THAT(end.out, AllOf(HasSubstr("Teaser"), HasSubstr("overlap"), HasSubstr("threshold 0.35"),
                             HasSubstr("yaw pitch roll"), HasSubstr("std. deviation"),
                             HasSubstr("accepted")));
}

/** The cloud in survey coordinates, in a file that keeps doubles. */
std::string surveyPly(const Points& points, const Eigen::Vector3d& origin, bool as_floats) {
  std::string text = "ply\nformat binary_little_endian 1.0\nelement vertex " +
                     std::to_string(points.size()) +
                     "\nproperty double x\nproperty double y\nproperty double z\nend_header\n";
  for (const auto& p : points)
    for (int axis = 0; axis < 3; ++axis) {
      const double coordinate = p[axis] + origin[axis];
      const double value = as_floats ? static_cast<float>(coordinate) : coordinate;
      text.append(reinterpret_cast<const char*>(&value), sizeof value);
    }
  return text;
}

Eigen::Vector3d offsetOf(const nlohmann::json& cloud) {
  return Eigen::Vector3d(cloud["offset"][0].get<double>(), cloud["offset"][1].get<double>(),
                         cloud["offset"][2].get<double>());
}

TEST_F(RegisterPair, WorksInSurveyCoordinates) {
  const Eigen::Vector3d utm(431200.25, 5412310.5, 312);
  const std::string target =
      file("utm_target.ply", surveyPly(scan(world_, world_T_target_, 1), utm, false));
  const std::string source =
      file("utm_source.ply", surveyPly(scan(world_, world_T_source_, 2), utm, false));
  const LampResult end = run({source, target});
  ASSERT_EQ(end.exit_code, 0) << end.err;
  const auto result = json();
  ASSERT_TRUE(result["accepted"]) << end.out << end.err;
  EXPECT_THAT(end.out, HasSubstr("less 431200 5412300 300 m"));
  EXPECT_EQ(offsetOf(result["source"]), offsetOf(result["target"]));
  Pose3 found;
  for (int i = 0; i < 16; ++i) found.matrix()(i / 4, i % 4) = result["target_T_source"][i];
  // Where a point of the source comes to lie, against where the truth puts it.
  const Eigen::Vector3d point(1, 2, 0.5);
  const Eigen::Vector3d moved =
      offsetOf(result["target"]) + found * (point + utm - offsetOf(result["source"]));
  const Eigen::Vector3d expected = world_T_target_.inverse() * world_T_source_ * point + utm;
  EXPECT_LT((moved - expected).norm(), 0.05);
}

TEST_F(RegisterPair, AMapInAFrameOfItsOwnStatesItsOffset) {
  const Eigen::Vector3d offset(431200, 5412300, 0);
  std::string text = plyText(scan(world_, world_T_target_, 1));
  text.insert(text.find("element"), "comment offset 431200 5412300 0\n");
  const std::string target = file("map.ply", text);
  const std::string source =
      file("utm_source.ply", surveyPly(scan(world_, world_T_source_, 2), offset, false));
  ASSERT_EQ(run({source, target}).exit_code, 0);
  const auto result = json();
  EXPECT_TRUE(result["accepted"]) << result["reason"];
  EXPECT_EQ(offsetOf(result["target"]), offset);
  EXPECT_EQ(offsetOf(result["source"]), offset);
}

/** A map of a building, with z up, as seen from all around it. */
std::string mapOf(const BoxWorld& world) {
  Points points;
  unsigned seed = 10;
  for (const Pose3& place : {at(4, 4, 0), at(10, 3.5, 1), at(16, 4, 2), at(16, 11, 3),
                             at(10, 11, 4), at(4, 11, 5), at(4, 7.5, 6), at(16, 7.5, 1)})
    for (const auto& p : scan(world, place, ++seed)) points.push_back(place * p);
  return plyText(points);
}

TEST_F(RegisterPair, FindsTheScanInAMap) {
  BoxWorld world = world_;  // with what tells the one end of the building from the other
  world.add({{0, 12.2, 0}, {7, 15, 3}});
  world.add({{8, 0, 0}, {12, 2.2, 3}});
  world.add({{0, 0, 0}, {1.8, 6, 3}});
  const std::string source = file("scan.ply", plyText(scan(world, world_T_source_, 2)));
  const LampResult end = run({source, file("map.ply", mapOf(world))});
  ASSERT_EQ(end.exit_code, 0) << end.err;
  const auto result = json();
  ASSERT_TRUE(result["accepted"]) << end.out;
  Pose3 found;
  for (int i = 0; i < 16; ++i) found.matrix()(i / 4, i % 4) = result["target_T_source"][i];
  const Pose3 error = found.inverse() * world_T_source_;
  EXPECT_LT(error.translation().norm(), 0.1);
  EXPECT_LT(rotationAngle(error), 0.02);
}

TEST_F(RegisterPair, RefusesAMapInWhichTwoPlacesLookAlike) {
  ASSERT_EQ(run({source_, file("map.ply", mapOf(world_))}).exit_code, 0);
  EXPECT_FALSE(json()["accepted"]);
  EXPECT_THAT(json()["reason"].get<std::string>(), HasSubstr("look alike"));
}

TEST_F(RegisterPair, RefusesAMapOfAnotherPlace) {
  ASSERT_EQ(run({source_, file("map.ply", mapOf(BoxWorld::building(8)))}).exit_code, 0);
  EXPECT_FALSE(json()["accepted"]);
}

TEST_F(RegisterPair, NoiseAllOverSpaceDoesNotCoarsenTheSurfaces) {
  Points points = scan(world_, world_T_source_, 2);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> anywhere(-300, 300);
  for (int i = 0; i < 4000; ++i)
    points.emplace_back(anywhere(random), anywhere(random), anywhere(random));
  ASSERT_EQ(run({file("rain.ply", plyText(points)), target_}).exit_code, 0);
  const auto result = json();
  EXPECT_TRUE(result["accepted"]) << result["reason"];
  EXPECT_GT(result["source"]["left_out"], 3900);
  EXPECT_LE(result["source"]["left_out"], 4000);
}

TEST_F(RegisterPair, CoordinatesThatWereRoundedOrAreNoMetresAreErrorsWithACure) {
  const Points points = scan(world_, world_T_source_, 2);
  const std::string rounded =
      file("rounded.ply", surveyPly(points, {431200.25, 5412345.5, 312}, true));
  const LampResult of_rounded = run({rounded, target_});
  EXPECT_EQ(of_rounded.exit_code, kFailed);
  EXPECT_THAT(of_rounded.err, AllOf(HasSubstr("rounded.ply"), HasSubstr("rounds them to 0.5 m"),
                                    HasSubstr("64-bit")));
  Points millimetres;
  for (const auto& p : points) millimetres.push_back(1000 * p);
  const LampResult of_millimetres = run({file("mm.ply", plyText(millimetres)), target_});
  EXPECT_EQ(of_millimetres.exit_code, kFailed);
  EXPECT_THAT(of_millimetres.err, AllOf(HasSubstr("mm.ply"), HasSubstr("millimetres")));
}

TEST_F(RegisterPair, JsonCanTakeThePlaceOfTheReport) {
  const LampResult end = runRegister({source_, target_, "--json", "-"});
  ASSERT_EQ(end.exit_code, 0) << end.err;
  EXPECT_TRUE(nlohmann::json::parse(end.out)["accepted"]);
}

TEST_F(RegisterPair, TheIniChoosesStages) {
  const std::string ini = file("pair.ini", "[pipeline]\ninitial_aligner = IdentityGuess\n");
  ASSERT_EQ(run({source_, target_, "--config", ini}).exit_code, 0);
  EXPECT_EQ(json()["hypotheses"][0]["aligner"], "IdentityGuess");
  EXPECT_FALSE(json()["accepted"]) << "120 degrees are too far for GICP alone";
  ASSERT_EQ(json()["target_T_source"].size(), 16u) << "what was refused is shown";
}

TEST_F(RegisterPair, KeyedCloudsAreNotThinned) {
  ASSERT_EQ(run({source_, target_, "--set", "frontend.keyed=true"}).exit_code, 0);
  EXPECT_EQ(json()["source"]["used"], json()["source"]["points"]);
  EXPECT_TRUE(json()["source"]["leaf_m"].is_null());
}

TEST_F(RegisterPair, UnrelatedCloudsAreRefused) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> place(-8, 8);
  Points noise;
  for (int i = 0; i < 2500; ++i) noise.emplace_back(place(random), place(random), place(random));
  const LampResult end = run({file("noise.ply", plyText(noise)), target_});
  EXPECT_EQ(end.exit_code, 0) << "a refusal is a result: " << end.err;
  EXPECT_FALSE(json()["accepted"]);
  EXPECT_NE(json()["stage"], "verified");
  EXPECT_NE(json()["reason"], "");
  EXPECT_THAT(end.out, HasSubstr("refused by"));
}

TEST_F(RegisterPair, WhereNothingAlignsThereIsNoPose) {
  const Points few{{0, 0, 0}, {1, 0, 0}, {0, 1, 1}};
  const LampResult end =
      run({file("few.ply", plyText(few)), target_, "--picture", experiment_.path("few.png")});
  EXPECT_EQ(end.exit_code, 0) << end.err;
  EXPECT_TRUE(json()["target_T_source"].is_null());
  EXPECT_TRUE(json()["information"].is_null());
  EXPECT_EQ(json()["stage"], "Teaser");
  EXPECT_THAT(readTextFile(experiment_.path("few.png")), HasSubstr("PNG"));
}

TEST_F(RegisterPair, LeavesOutWhatIsNowhereAndSaysSo) {
  const std::string holes =
      file("holes.ply", plyText(scan(world_, world_T_source_, 2), "nan 1 2\n"));
  const LampResult end = run({holes, target_});
  EXPECT_EQ(end.exit_code, 0) << end.err;
  EXPECT_THAT(end.out, HasSubstr("1 left out"));
  EXPECT_EQ(json()["source"]["left_out"], 1);
}

TEST_F(RegisterPair, FilesThatCannotBeUsedAreFailures) {
  const auto expect_failure = [&](const std::string& source, const std::string& what) {
    const LampResult end = runRegister({source, target_});
    EXPECT_EQ(end.exit_code, kFailed) << source;
    EXPECT_THAT(end.err, AllOf(HasSubstr(source), HasSubstr(what)));
    EXPECT_THAT(end.out, IsEmpty());
  };
  expect_failure(experiment_.path("missing.pcd"), "there is no such file");
  expect_failure(file("none.ply", plyText({})), "holds no point");
  expect_failure(file("bad.pcd", "VERSION 0.7\nFIELDS\nrubbish\n"), ":3: is not a line");
  expect_failure(file("cloud.xyz", "1 2 3\n"), ".ply or .pcd");
  expect_failure(file("far.ply", plyText({{1e7, 0, 0}})), "rounds them to 1 m");
}

TEST_F(RegisterPair, AResultThatCannotBeWrittenIsAFailure) {
  for (const char* option : {"--json", "--picture"}) {
    const LampResult end =
        runRegister({source_, target_, option, experiment_.path("missing/result")});
    EXPECT_EQ(end.exit_code, kFailed) << option;
    EXPECT_THAT(end.err, HasSubstr("missing/result"));
  }
}

TEST_F(RegisterPair, FaultsOfTheIniAreWrongUse) {
  const LampResult key = runRegister({source_, target_, "--set", "pipeline.refinner=Gicp"});
  EXPECT_EQ(key.exit_code, kWrongUse);
  EXPECT_THAT(key.err, HasSubstr("did you mean 'refiner'"));
  const std::string ini = file("bad.ini", "[registration]\nvoxel = 1\n");
  const LampResult file_key = runRegister({source_, target_, "--config", ini});
  EXPECT_EQ(file_key.exit_code, kWrongUse);
  EXPECT_THAT(file_key.err, HasSubstr(ini + ":2"));
}

TEST(RegisterCommandLine, HelpVersionAndWrongUse) {
  const LampResult help = runRegister({"--help"});
  EXPECT_EQ(help.exit_code, 0);
  for (const char* word : {"SOURCE", "TARGET", "--config", "--set", "--json", "--picture"})
    EXPECT_THAT(help.out, HasSubstr(word));
  const LampResult version = runRegister({"--version"});
  EXPECT_EQ(version.exit_code, 0);
  EXPECT_THAT(version.out, testing::MatchesRegex("lamp-register [0-9]+\\.[0-9]+\\.[0-9]+\n"));
  EXPECT_EQ(runRegister({}).exit_code, kWrongUse);
  EXPECT_EQ(runRegister({"one.ply"}).exit_code, kWrongUse);
  EXPECT_EQ(runRegister({"one.ply", "two.ply", "--colour"}).exit_code, kWrongUse);
}

}  // namespace
}  // namespace lamp::test
