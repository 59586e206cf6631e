// Input that is keyed already, through the real program: key nodes as another run, or a simulator,
// has written them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <mrpt/maps/CSimplePointsMap.h>
#include <mrpt/obs/CObservationIMU.h>
#include <mrpt/obs/CRawlog.h>

#include "Experiment.h"
#include "Measures.h"
#include "lamp/core/GraphFiles.h"

namespace lamp::test {
namespace {

using mrpt::obs::CObservation;
using mrpt::obs::CObservationIMU;
using mrpt::obs::CObservationPointCloud;
using mrpt::obs::CObservationRobotPose;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

constexpr double kRearX = -0.4, kHeight = 0.3;

/** What one lidar saw at a key node: its origin, then its points, in the base frame. */
using KeyedClouds =
    std::map<std::pair<mrpt::Clock::time_point, std::string>, std::vector<mrpt::math::TPoint3D>>;

std::vector<CObservation::Ptr> readRawlog(const std::string& path) {
  mrpt::obs::CRawlog rawlog;
  EXPECT_TRUE(rawlog.loadFromRawLogFile(path)) << path;
  std::vector<CObservation::Ptr> observations;
  for (size_t i = 0; i < rawlog.size(); ++i) observations.push_back(rawlog.getAsObservation(i));
  return observations;
}

KeyedClouds cloudsOf(const std::string& path) {
  KeyedClouds clouds;
  for (const auto& observation : readRawlog(path)) {
    const auto* cloud = dynamic_cast<const CObservationPointCloud*>(observation.get());
    if (!cloud) continue;
    auto& points = clouds[{cloud->timestamp, cloud->sensorLabel}];
    points.push_back(cloud->sensorPose.translation());
    for (size_t i = 0; i < cloud->pointcloud->size(); ++i) {
      mrpt::math::TPoint3D p;
      cloud->pointcloud->getPoint(i, p.x, p.y, p.z);
      points.push_back(cloud->sensorPose.composePoint(p));
    }
  }
  return clouds;
}

void expectSameClouds(const KeyedClouds& one, const KeyedClouds& two) {
  ASSERT_EQ(one.size(), two.size());
  for (const auto& [key, points] : one) {
    const auto found = two.find(key);
    ASSERT_NE(found, two.end()) << key.second;
    ASSERT_EQ(points.size(), found->second.size()) << key.second;
    for (size_t i = 0; i < points.size(); ++i)
      ASSERT_LT((points[i] - found->second[i]).norm(), 1e-5) << key.second << " " << i;
  }
}

/** The lidar's backward points as those of a second one, mounted behind it; from the second scan
 * on, so that the first one stays the reference. */
Objects withRearLidar(const Objects& objects) {
  Objects result;
  bool first = true;
  for (const auto& object : objects) {
    const auto scan = std::dynamic_pointer_cast<CObservationPointCloud>(object);
    if (scan && !std::exchange(first, false)) {
      const auto rear =
          std::dynamic_pointer_cast<CObservationPointCloud>(scan->duplicateGetSmartPtr());
      rear->sensorLabel = scan->sensorLabel.substr(0, scan->sensorLabel.find('/')) + "/rear";
      rear->sensorPose = mrpt::poses::CPose3D::FromTranslation(kRearX, 0, kHeight);
      auto front_points = mrpt::maps::CSimplePointsMap::Create();
      auto rear_points = mrpt::maps::CSimplePointsMap::Create();
      for (size_t i = 0; i < scan->pointcloud->size(); ++i) {
        float x, y, z;
        scan->pointcloud->getPoint(i, x, y, z);
        if (x < 0)
          rear_points->insertPointFast(x - static_cast<float>(kRearX), y, z);
        else
          front_points->insertPointFast(x, y, z);
      }
      scan->pointcloud = front_points;
      rear->pointcloud = rear_points;
      result.push_back(rear);
    }
    result.push_back(object);
  }
  return result;
}

/** Two robots with two lidars each, mapped once from raw recordings. */
class Keyed : public testing::Test {
 protected:
  Keyed() {
    const BoxWorld world = BoxWorld::building(7);
    a_ = record("A", {{3, 3}, {17, 3}, {17, 9}}, 1, world);
    b_ = record("B", {{17, 9}, {17, 3}, {3, 3}}, 2, world);
    const std::string starts =
        startSection("A", a_.truth.front().pose) + startSection("B", b_.truth.front().pose);
    raw_ = experiment_.file("raw.ini", iniFor3d("", starts));
    // Whatever the options say that keyed input does not need.
    keyed_ = experiment_.file("keyed.ini",
                              "[frontend]\nkeyed = true\nkey_node_distance_m = 7\nmin_range_m = 2\n"
                              "max_range_m = 5\ntarget_points = 50\n[pipeline]\nexporters =\n" +
                                  starts);
    const LampResult end = experiment_.run({raw_, experiment_.rawlog("A.rawlog", a_.objects),
                                            experiment_.rawlog("B.rawlog", b_.objects)},
                                           "raw");
    EXPECT_EQ(end.exit_code, 0) << end.err;
  }

  static Recording record(const std::string& name, const std::vector<Eigen::Vector2d>& route,
                          unsigned seed, const BoxWorld& world) {
    SyntheticRobot robot;
    robot.name = name;
    robot.route = route;
    robot.seed = seed;
    Recording recording = robot.record3d(world);
    recording.objects = withRearLidar(recording.objects);
    return recording;
  }

  std::string keyNodes(const std::string& run, const std::string& robot) const {
    return experiment_.result(run).folder().keyNodes(robot);
  }

  /** The run has the key nodes of the raw one, and a map as good. */
  void expectAsRaw(const std::string& run) const {
    for (const auto& [name, recording] : {std::pair{"A", a_}, std::pair{"B", b_}}) {
      const KeyedClouds clouds = cloudsOf(keyNodes("raw", name));
      const size_t nodes = experiment_.result("raw").keyNodes(name).size();
      ASSERT_EQ(clouds.size(), 2 * nodes - 1) << "two lidars, but at the first key node";
      expectSameClouds(clouds, cloudsOf(keyNodes(run, name)));
      const FinishedRun result = experiment_.result(run);
      EXPECT_EQ(result.keyNodes(name).size(), nodes);
      EXPECT_EQ(result.trajectory(name).size(), nodes);
      const auto odometry = ateFromFirst(result.odometry(name), recording.truth);
      const auto mapped = ateFromFirst(result.trajectory(name), recording.truth);
      RecordProperty(run + "_ate_m_" + name, std::to_string(mapped));
      EXPECT_LT(mapped, std::max(0.7 * odometry, 0.02)) << name;
    }
    EXPECT_EQ(experiment_.result(run).summary()["components"].size(), 1u);
  }

  Recording a_, b_;
  Experiment experiment_;
  std::string raw_, keyed_;
};

TEST_F(Keyed, AKeyNodesFolderReadsBackToTheSameKeyNodes) {
  const LampResult end =
      experiment_.run({keyed_, keyNodes("raw", "A"), keyNodes("raw", "B")}, "keyed");
  ASSERT_EQ(end.exit_code, 0) << end.err;
  expectAsRaw("keyed");

  const LampResult again =
      experiment_.run({keyed_, keyNodes("keyed", "A"), keyNodes("keyed", "B")}, "again");
  ASSERT_EQ(again.exit_code, 0) << again.err;
  expectAsRaw("again");
}

/** Gives odometry readings the covariance that grows along their way by `step` from each to the
 * next. */
class GrowingCovariance {
 public:
  void giveTo(CObservationRobotPose& odometry) {
    const Pose3 pose(
        odometry.pose.mean.getHomogeneousMatrixVal<mrpt::math::CMatrixDouble44>().asEigen());
    const Matrix6d step =
        (Vector6d() << 2e-3, 2e-3, 2e-3, 1e-3, 1e-3, 1e-3).finished().asDiagonal();
    covariance_ = composeCovariance(covariance_, last_.inverse() * pose, step);
    last_ = pose;
    const Matrix6d recorded = covarianceToMrpt(pose, covariance_);
    for (int i = 0; i < 36; ++i) odometry.pose.cov(i / 6, i % 6) = recorded(i / 6, i % 6);
  }

 private:
  Pose3 last_ = Pose3::Identity();
  Matrix6d covariance_ = Matrix6d::Zero();
};

/** As a simulator may write it: clouds before the odometry, whose covariance grows, and other
 * sensors between them. */
Objects asSimulated(const std::vector<CObservation::Ptr>& observations) {
  Objects result;
  CObservationRobotPose::Ptr odometry;
  GrowingCovariance covariance;
  const auto flush = [&] {
    if (odometry) result.push_back(odometry);
  };
  for (const auto& observation : observations) {
    if (const auto next = std::dynamic_pointer_cast<CObservationRobotPose>(observation)) {
      flush();
      odometry = next;
      covariance.giveTo(*odometry);
      auto imu = CObservationIMU::Create();
      imu->timestamp = odometry->timestamp;
      imu->sensorLabel = odometry->sensorLabel.substr(0, 1) + "/imu";
      result.push_back(imu);
    } else {
      result.push_back(observation);
    }
  }
  flush();
  return result;
}

TEST_F(Keyed, TheOrderWithinAStampDoesNotMatter) {
  std::vector<std::string> arguments = {keyed_};
  for (const std::string name : {"A", "B"})
    arguments.push_back(experiment_.rawlog("recordings/" + name + ".rawlog",
                                           asSimulated(readRawlog(keyNodes("raw", name)))));
  const LampResult end = experiment_.run(arguments, "simulated");
  ASSERT_EQ(end.exit_code, 0) << end.err;
  EXPECT_THAT(end.err, IsEmpty());
  expectAsRaw("simulated");
}

}  // namespace
}  // namespace lamp::test
