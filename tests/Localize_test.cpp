// lamp-localize, through the real program, in a building that was surveyed.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <functional>
#include <set>
#include <tuple>

#include "BoxWorld.h"
#include "Experiment.h"
#include "Measures.h"
#include "lamp/core/Files.h"
#include "lamp/core/Trajectory.h"

namespace lamp::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

constexpr int kFailed = 1, kWrongUse = 2;

/** Along the corridor. */
std::vector<Eigen::Vector3d> stations() {
  std::vector<Eigen::Vector3d> places;
  for (double x = 2; x <= 18; x += 2)
    for (const double y : {3.0, 12.0}) places.emplace_back(x, y, 1.5);
  for (double y = 5; y <= 10; y += 2.5)
    for (const double x : {3.0, 17.0}) places.emplace_back(x, y, 1.5);
  return places;
}

/** What a surveyor's scanner sees from its stations, 5 cm apart. */
std::vector<Eigen::Vector3d> surveyed(const BoxWorld& world,
                                      const std::vector<Eigen::Vector3d>& stations) {
  std::set<std::tuple<long, long, long>> cells;
  std::vector<Eigen::Vector3d> points;
  for (const Eigen::Vector3d& station : stations)
    for (int up = -80; up <= 80; ++up)
      for (int around = 0; around < 360; ++around) {
        const double elevation = up * M_PI / 180, azimuth = around * M_PI / 180;
        const Eigen::Vector3d ray(std::cos(elevation) * std::cos(azimuth),
                                  std::cos(elevation) * std::sin(azimuth), std::sin(elevation));
        const Eigen::Vector3d p = station + world.range(station, ray) * ray;
        if (p.allFinite() &&
            cells.emplace(std::lround(20 * p.x()), std::lround(20 * p.y()), std::lround(20 * p.z()))
                .second)
          points.push_back(p);
      }
  return points;
}

std::string plyOf(const std::vector<Eigen::Vector3d>& points) {
  std::string vertices;
  for (const Eigen::Vector3d& point : points)
    vertices.append(reinterpret_cast<const char*>(point.data()), sizeof(double) * 3);
  return "ply\nformat binary_little_endian 1.0\nelement vertex " + std::to_string(points.size()) +
         "\nproperty double x\nproperty double y\nproperty double z\nend_header\n" + vertices;
}

/** A robot once around the corridor of a building. */
class Localize : public testing::Test {
 protected:
  std::string surveyFile(const Eigen::Vector3d& shift = Eigen::Vector3d::Zero(),
                         const std::function<bool(const Eigen::Vector3d&)>& holds = {}) const {
    std::vector<Eigen::Vector3d> points;
    for (const Eigen::Vector3d& point : surveyed(world_, stations()))
      if (!holds || holds(point)) points.push_back(point + shift);
    return experiment_.file("survey.ply", plyOf(points));
  }
  LampResult run(std::vector<std::string> arguments) const {
    arguments.insert(arguments.end(), {"--out", experiment_.path("reference")});
    return runLocalize(arguments);
  }
  /** An ini with the start pose. */
  std::string ini(const Pose3& start) const {
    return experiment_.file("start.ini", iniFor3d("", startSection("A", start)));
  }
  std::vector<StampedPose> localized() const {
    return readTum(experiment_.path("reference/A.tum"));
  }
  /** Root mean square of the position errors; nothing is aligned. \param shift of the survey. */
  double rms(const std::vector<StampedPose>& poses,
             const Eigen::Vector3d& shift = Eigen::Vector3d::Zero()) const {
    const TrajectoryInterpolator truth(recording_.truth);
    double sum = 0;
    for (const StampedPose& pose : poses)
      sum += (pose.pose.translation() - shift - truth.at(pose.stamp).translation()).squaredNorm();
    return std::sqrt(sum / static_cast<double>(poses.size()));
  }

  const BoxWorld world_ = BoxWorld::building(3);
  const Experiment experiment_;
  const Recording recording_ = SyntheticRobot{"A", ringRoute()}.record3d(world_);
  const std::string rawlog_ = experiment_.rawlog("A.rawlog", recording_.objects);
  const Pose3 start_ = recording_.truth.front().pose;
};

TEST_F(Localize, TheTrajectoryInTheSurveysFrame) {
  const LampResult end = run({surveyFile(), rawlog_, "--config", ini(start_)});
  ASSERT_EQ(end.exit_code, 0) << end.err;
  const auto poses = localized();
  EXPECT_GT(poses.size(), 0.95 * static_cast<double>(recording_.truth.size())) << end.out;
  EXPECT_LT(rms(poses), 0.02);
  EXPECT_THAT(end.out, AllOf(HasSubstr("A: " + std::to_string(poses.size()) + " of "),
                             HasSubstr("of their points lie on the survey")));
}

TEST_F(Localize, OneRobotsTrajectoryMayBeAFile) {
  const std::string file = experiment_.path("one.tum");
  const LampResult end =
      runLocalize({surveyFile(), rawlog_, "--config", ini(start_), "--out", file});
  ASSERT_EQ(end.exit_code, 0) << end.err;
  EXPECT_LT(rms(readTum(file)), 0.02);
}

TEST_F(Localize, SurveysInANationalGrid) {
  const Eigen::Vector3d shift(445123, 4477456, 650);
  Pose3 start = start_;
  start.pretranslate(shift);
  const LampResult end = run({surveyFile(shift), rawlog_, "--config", ini(start)});
  ASSERT_EQ(end.exit_code, 0) << end.err;
  EXPECT_LT(rms(localized(), shift), 0.02);
}

/** Only that is written which the survey confirms. */
TEST_F(Localize, WhatWasNotSurveyedIsLeftOut) {
  const LampResult end = run({surveyFile({}, [](const auto& point) { return point.x() < 11; }),
                              rawlog_, "--config", ini(start_)});
  ASSERT_EQ(end.exit_code, 0) << end.err;
  const auto poses = localized();
  EXPECT_LT(rms(poses), 0.03);
  EXPECT_GT(poses.size(), recording_.truth.size() / 10);
  EXPECT_LT(poses.size(), 2 * recording_.truth.size() / 3);
  for (const StampedPose& pose : poses) EXPECT_LT(pose.pose.translation().x(), 13);
  EXPECT_THAT(end.out, HasSubstr("left out, since the survey does not confirm"));
}

TEST_F(Localize, AnotherBuildingIsAFailureThatSaysWhatToDo) {
  const std::string survey = surveyFile();
  const std::string elsewhere = experiment_.rawlog(
      "B.rawlog",
      SyntheticRobot{"A", shortRoute()}.record3d(BoxWorld::building(8, {40, 30})).objects);
  const LampResult end = run({survey, elsewhere, "--config", ini(start_)});
  EXPECT_EQ(end.exit_code, kFailed);
  EXPECT_THAT(end.err, AllOf(HasSubstr("no scan could be localised"), HasSubstr("start pose")));
  EXPECT_THAT(end.out, IsEmpty());
  EXPECT_FALSE(std::filesystem::exists(experiment_.path("reference/A.tum")));
}

TEST_F(Localize, AStartPoseInAnotherFrameIsRefused) {
  Pose3 start = start_;
  start.translation().x() += 500000;
  const LampResult end = run({surveyFile(), rawlog_, "--config", ini(start)});
  EXPECT_EQ(end.exit_code, kFailed);
  EXPECT_THAT(end.err, AllOf(HasSubstr("robot 'A'"), HasSubstr("500.0 km"), HasSubstr("frame")));
}

TEST_F(Localize, MillimetresAreRefused) {
  const std::string survey = experiment_.file(
      "small.ply",
      "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\nproperty float "
      "z\nend_header\n1 2 3\n1.001 2 3\n");
  const LampResult end = run({survey, rawlog_});
  EXPECT_EQ(end.exit_code, kFailed);
  EXPECT_THAT(end.err, AllOf(HasSubstr(survey), HasSubstr("metres")));
}

/** In a room, as the search takes time. */
TEST(LocalizeInARoom, ARobotWithoutAStartPoseIsSought) {
  BoxWorld room;
  room.add({{-0.2, -0.2, -0.2}, {8.2, 6.2, 0}});
  room.add({{-0.2, -0.2, 3}, {8.2, 6.2, 3.2}});
  room.add({{-0.2, 0, 0}, {0, 6, 3}});
  room.add({{8, 0, 0}, {8.2, 6, 3}});
  room.add({{0, -0.2, 0}, {8, 0, 3}});
  room.add({{0, 6, 0}, {8, 6.2, 3}});
  room.add({{0, 4.5, 0}, {1.2, 6, 2}});
  room.add({{3, 0, 0}, {3.8, 0.6, 1.4}});
  room.add({{6.5, 4, 0}, {8, 4.6, 2.4}});
  const Experiment experiment;
  const Recording recording = SyntheticRobot{"A", {{2, 2}, {6, 2.5}}}.record3d(room);
  const std::string survey =
      experiment.file("room.ply", plyOf(surveyed(room, {{2, 2, 1.5}, {6, 2, 1.5}, {4, 4.5, 1.5}})));
  const LampResult end = runLocalize({survey, experiment.rawlog("A.rawlog", recording.objects),
                                      "--out", experiment.path("reference")});
  ASSERT_EQ(end.exit_code, 0) << end.err;
  const auto poses = readTum(experiment.path("reference/A.tum"));
  EXPECT_GT(poses.size(), recording.truth.size() / 2) << end.out;
  const TrajectoryInterpolator truth(recording.truth);
  for (const StampedPose& pose : poses)
    EXPECT_LT((pose.pose.translation() - truth.at(pose.stamp).translation()).norm(), 0.05);
}

TEST(LocalizeCommandLine, WrongUse) {
  const LampResult nothing = runLocalize({});
  EXPECT_EQ(nothing.exit_code, kWrongUse);
  const LampResult no_rawlog = runLocalize({"survey.ply", "--out", "somewhere"});
  EXPECT_EQ(no_rawlog.exit_code, kWrongUse);
  EXPECT_THAT(no_rawlog.err, HasSubstr("name a recording"));
  const LampResult help = runLocalize({"--help"});
  EXPECT_EQ(help.exit_code, 0);
  for (const char* word : {"SURVEY", "RAWLOG", "--out", "--config", "--set", "--version"})
    EXPECT_THAT(help.out, HasSubstr(word));
  EXPECT_THAT(runLocalize({"--version"}).out, HasSubstr("lamp-localize "));
}

}  // namespace
}  // namespace lamp::test
