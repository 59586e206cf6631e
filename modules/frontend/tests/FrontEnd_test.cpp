#include "lamp/frontend/FrontEnd.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <random>

#include "TestObservations.h"
#include "lamp/frontend/RecordedOdometry.h"

namespace lamp {
namespace {

using namespace test;
using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/** A front end, and all that it gave. */
class Drive {
 public:
  explicit Drive(const FrontEndOptions& options = {}, std::optional<StartPrior> prior = {})
      : front_end(
            kRobot, options,
            std::vector<std::shared_ptr<OdometrySource>>{std::make_shared<RecordedOdometry>()},
            std::move(prior)) {}

  void observe(const InputObservation& observation) { keep(front_end.observe(observation)); }
  void finish() {
    keep(front_end.finish());
    end = front_end.end();
  }

  /** Stamps of all scans that are told of, in the order of telling. */
  std::vector<double> stamps() const {
    std::vector<double> result;
    for (const KeyNodePacket& packet : packets) {
      for (const StampedPose& scan : packet.passed_scans) result.push_back(scan.stamp);
      result.push_back(packet.stamp);
    }
    for (const StampedPose& scan : end.passed_scans) result.push_back(scan.stamp);
    return result;
  }

  FrontEnd front_end;
  std::vector<KeyNodePacket> packets;
  RobotEnd end;

 private:
  void keep(std::vector<KeyNodePacket> more) {
    for (KeyNodePacket& packet : more) packets.push_back(std::move(packet));
  }
};

/** A straight drive with scans every 0.3 m and odometry between them. */
void driveStraight(Drive& drive, int scans) {
  for (int i = 0; i < scans; ++i) {
    drive.observe(wheels(kStart + i - 0.5, 0.3 * (i - 0.5)));
    drive.observe(cloud(kStart + i, somePoints()));
  }
  drive.observe(wheels(kStart + scans, 0.3 * scans));
  drive.finish();
}

TEST(FrontEnd, MakesKeyNodesEveryTwoMetres) {
  StartPrior prior;
  prior.world_T_base = planarPose(5, 6, 0.7);
  Drive drive({}, prior);
  driveStraight(drive, 24);
  ASSERT_EQ(drive.packets.size(), 4u);
  for (uint32_t k = 0; k < 4; ++k) {
    const KeyNodePacket& packet = drive.packets[k];
    EXPECT_EQ(packet.id, (KeyNodeId{kRobot, k}));
    EXPECT_NEAR(packet.stamp, kStart + 7 * k, 1e-6) << "2.1 m are the first 0.3 m beyond 2 m";
    EXPECT_NEAR(packet.odom_T_base.translation().x(), 2.1 * k, 1e-6);
    EXPECT_EQ(packet.scan->size(), somePoints().size());
    EXPECT_EQ(packet.odometry.has_value(), k > 0);
    EXPECT_EQ(packet.prior.has_value(), k == 0);
    if (k == 0) continue;
    EXPECT_LT((packet.odometry->previous_T_this.matrix() - planarPose(2.1, 0, 0).matrix()).norm(),
              1e-6);
  }
  EXPECT_EQ(drive.packets[0].prior->world_T_base.matrix(), prior.world_T_base.matrix());
  EXPECT_EQ(drive.front_end.counts().scans, 24u);
  EXPECT_EQ(drive.front_end.counts().key_nodes, 4u);
  EXPECT_THAT(drive.front_end.warnings(), IsEmpty());
}

TEST(FrontEnd, MakesKeyNodesEveryThirtyDegrees) {
  Drive drive;
  for (int i = 0; i <= 20; ++i) {
    drive.observe(wheels(kStart + i, 0, 0, 7 * kDegree * i));
    drive.observe(cloud(kStart + i, somePoints()));
  }
  drive.finish();
  ASSERT_EQ(drive.packets.size(), 5u);
  for (size_t k = 0; k < 5; ++k)
    EXPECT_NEAR(yawOf(drive.packets[k].odom_T_base), 35 * kDegree * static_cast<double>(k), 1e-6);
}

TEST(FrontEnd, TellsOfEveryScanOnce) {
  Drive drive;
  driveStraight(drive, 24);
  std::vector<double> expected;
  for (int i = 0; i < 24; ++i) expected.push_back(kStart + i);
  EXPECT_EQ(drive.stamps(), expected);
  EXPECT_EQ(drive.end.robot, kRobot);
  EXPECT_EQ(drive.end.passed_scans.size(), 2u);
  for (const StampedPose& scan : drive.packets[2].passed_scans)
    EXPECT_NEAR(scan.pose.translation().x(), 0.3 * (scan.stamp - kStart), 1e-6);
}

TEST(FrontEnd, ScansWaitForOdometry) {
  Drive drive;
  drive.observe(wheels(kStart, 0));
  drive.observe(cloud(kStart + 0.75, somePoints()));
  EXPECT_THAT(drive.packets, IsEmpty());
  drive.observe(wheels(kStart + 0.5, 1));
  EXPECT_THAT(drive.packets, IsEmpty());
  drive.observe(cloud(kStart + 1.75, somePoints()));
  EXPECT_THAT(drive.packets, IsEmpty()) << "now it is known to be a whole scan";
  drive.observe(wheels(kStart + 1, 2));
  ASSERT_EQ(drive.packets.size(), 1u);
  EXPECT_NEAR(drive.packets[0].odom_T_base.translation().x(), 1.5, 1e-6);
}

TEST(FrontEnd, ScansJustAfterTheLastOdometryStandWhereItEnded) {
  Drive drive;
  drive.observe(wheels(kStart, 0));
  drive.observe(wheels(kStart + 1, 5));
  for (const double t : {0.0, 1.0, 1.2, 60.0}) drive.observe(cloud(kStart + t, somePoints()));
  drive.finish();
  EXPECT_EQ(drive.packets.size(), 2u);
  ASSERT_EQ(drive.end.passed_scans.size(), 1u);
  EXPECT_NEAR(drive.end.passed_scans[0].stamp, kStart + 1.2, 1e-6);
  EXPECT_NEAR(drive.end.passed_scans[0].pose.translation().x(), 5, 1e-6);
  EXPECT_EQ(drive.front_end.counts().without_odometry, 1u) << "nobody knows where it was by then";
  EXPECT_THAT(drive.front_end.warnings(), ElementsAre(HasSubstr("1 of 4 scans were dropped")));
}

TEST(FrontEnd, WithoutOdometryThereIsAWarningAndMemoryStaysBounded) {
  Drive drive;
  std::vector<std::weak_ptr<mrpt::obs::CObservation>> scans;
  for (int i = 0; i < 1000; ++i) {
    const InputObservation scan = cloud(kStart + i, somePoints());
    scans.push_back(scan.observation);
    drive.observe(scan);
  }
  size_t alive = 0;
  for (const auto& scan : scans) alive += scan.expired() ? 0 : 1;
  EXPECT_LE(alive, 250u);
  drive.finish();
  EXPECT_THAT(drive.packets, IsEmpty());
  EXPECT_THAT(drive.end.passed_scans, IsEmpty());
  EXPECT_EQ(drive.front_end.counts().without_odometry, 1000u);
  EXPECT_THAT(drive.front_end.warnings(),
              ElementsAre(HasSubstr("1000 of 1000 scans were dropped")));
}

TEST(FrontEnd, AnEmptyScanBecomesNoKeyNode) {
  Drive drive;
  for (int i = 0; i < 3; ++i) {
    drive.observe(wheels(kStart + i, 0));
    drive.observe(cloud(kStart + i, i == 0 ? std::vector<Eigen::Vector3f>{} : somePoints()));
  }
  drive.finish();
  ASSERT_EQ(drive.packets.size(), 1u);
  EXPECT_NEAR(drive.packets[0].stamp, kStart + 1, 1e-6);
  EXPECT_EQ(drive.packets[0].passed_scans.size(), 1u);
  EXPECT_EQ(drive.stamps().size(), 3u);
  EXPECT_EQ(drive.front_end.counts().empty_scans, 1u);
  EXPECT_THAT(drive.front_end.warnings(), ElementsAre(HasSubstr("1 scans had no usable point")));
}

/** One scan that cannot be used, and a good one. */
void expectUnreadable(const mrpt::obs::CObservation::Ptr& scan, const std::string& reason) {
  Drive drive;
  drive.observe(wheels(kStart, 0));
  drive.observe(wrapped(kStart, "lidar", scan));
  drive.observe(wheels(kStart + 1, 0));
  drive.observe(cloud(kStart + 1, somePoints()));
  drive.finish();
  EXPECT_EQ(drive.packets.size(), 1u);
  EXPECT_EQ(drive.stamps().size(), 2u);
  EXPECT_THAT(drive.front_end.warnings(), Contains(HasSubstr(reason)));
}

TEST(FrontEnd, SurvivesScansThatCannotBeRead) {
  using mrpt::obs::CObservationPointCloud;
  auto lost = CObservationPointCloud::Create();
  lost->setAsExternalStorage("/nowhere/lost.bin",
                             CObservationPointCloud::ExternalStorageFormat::KittiBinFile);
  expectUnreadable(lost, "lost.bin");

  auto unknown = mrpt::obs::CObservationRotatingScan::Create();
  unknown->rowCount = 4;
  unknown->columnCount = 8;
  unknown->rangeImage.resize(4, 8);
  expectUnreadable(unknown, "1 scans could not be read");
}

TEST(FrontEnd, KeyedScansComeNearTheTargetSize) {
  std::mt19937 random(1);
  std::uniform_real_distribution<float> unit(0.0f, 1.0f);
  std::vector<Eigen::Vector3f> hall;  // the floor and two walls, far more points than wanted
  for (int i = 0; i < 40000; ++i) {
    const float u = unit(random), v = unit(random);
    hall.push_back(i % 2 ? Eigen::Vector3f(30 * u - 15, 20 * v - 10, -0.5f)
                         : Eigen::Vector3f(30 * u - 15, i % 4 ? 10.0f : -10.0f, 4 * v));
  }
  FrontEndOptions options;
  options.voxel.target_points = 1200;
  Drive drive(options);
  for (int i = 0; i < 3; ++i) {
    drive.observe(wheels(kStart + i, 3.0 * i));
    drive.observe(cloud(kStart + i, hall));
  }
  drive.finish();
  ASSERT_EQ(drive.packets.size(), 3u);
  for (const KeyNodePacket& packet : drive.packets)
    EXPECT_NEAR(static_cast<double>(packet.scan->size()), 1200, 180);
}

/** Two lidars; the second one scans `gap` seconds before the first one. The robot drives 1 m/s. */
Scan scanOfTwoLidars(double gap) {
  Drive drive;
  for (int i = 0; i < 30; ++i) drive.observe(wheels(kStart - 2 + 0.1 * i, 0.1 * i));
  // The first observation of all says which lidar is the reference.
  drive.observe(cloud(kStart - 1.9, {{4, 0, 0}}, "front", {0.3, 0, 0.5}));
  drive.observe(cloud(kStart + 0.5 - gap, {{-6, 1, 0}}, "rear", {-0.4, 0, 0.6}));
  drive.observe(cloud(kStart + 0.5, {{4, 0, 0}, {0, 7, 1}}, "front", {0.3, 0, 0.5}));
  drive.finish();
  EXPECT_EQ(drive.packets.size(), 2u);
  EXPECT_EQ(drive.front_end.counts().scans, 2u) << "scans of the reference lidar";
  return *drive.packets.back().scan;
}

TEST(FrontEnd, MergesLidarsWithinTheWindow) {
  const Scan scan = scanOfTwoLidars(0.15);
  ASSERT_EQ(scan.size(), 3u);
  ASSERT_EQ(scan.sensors.size(), 2u);
  EXPECT_EQ(scan.sensors[0].label, "front");
  EXPECT_TRUE(scan.sensors[0].position.isApprox(Eigen::Vector3d(0.3, 0, 0.5), 1e-6));
  // In 0.15 s the robot has driven on by 0.15 m.
  EXPECT_EQ(scan.sensors[1].label, "rear");
  EXPECT_TRUE(scan.sensors[1].position.isApprox(Eigen::Vector3d(-0.55, 0, 0.6), 1e-5))
      << scan.sensors[1].position.transpose();
  EXPECT_EQ(scan.sensor, (std::vector<uint8_t>{0, 0, 1}));
  EXPECT_TRUE(scan.points[0].isApprox(Eigen::Vector3f(4.3f, 0, 0.5f), 1e-5f));
  EXPECT_TRUE(scan.points[2].isApprox(Eigen::Vector3f(-6.55f, 1, 0.6f), 1e-5f))
      << scan.points[2].transpose();
}

TEST(FrontEnd, DoesNotMergeOlderScans) {
  const Scan scan = scanOfTwoLidars(0.25);
  EXPECT_EQ(scan.size(), 2u);
  EXPECT_EQ(scan.sensors.size(), 1u);
}

TEST(FrontEnd, OdometryEdgesAreLessCertainAfterALongerWay) {
  const auto edge = [](double sway) {
    Drive drive;
    for (int i = 0; i <= 7; ++i) {
      drive.observe(wheels(kStart + i, 0.3 * i, 0, i % 2 ? sway : -sway));
      drive.observe(cloud(kStart + i, somePoints()));
    }
    drive.finish();
    EXPECT_EQ(drive.packets.size(), 2u);
    return drive.packets.back().odometry->covariance;
  };
  const MotionModelOptions model;
  const Matrix6d straight = edge(0), swaying = edge(0.2);
  EXPECT_TRUE(isCovariance(straight));
  EXPECT_NEAR(std::sqrt(straight(0, 0)), std::hypot(model.min_sigma_m, 2.1 * model.sigma_m_per_m),
              1e-9);
  EXPECT_NEAR(std::sqrt(straight(5, 5)),
              std::hypot(model.min_sigma_rad, 2.1 * model.sigma_rad_per_m), 1e-9);
  EXPECT_NEAR(std::sqrt(swaying(5, 5)),
              std::hypot(model.min_sigma_rad, 2.1 * model.sigma_rad_per_m,
                         7 * 0.4 * model.sigma_rad_per_rad),
              1e-9);
}

TEST(FrontEnd, TheWayStartsAnewAtEachKeyNode) {
  Drive drive;
  driveStraight(drive, 30);
  ASSERT_GE(drive.packets.size(), 3u);
  EXPECT_LT((drive.packets[1].odometry->covariance - drive.packets[2].odometry->covariance).norm(),
            1e-9);
}

TEST(FrontEnd, UsesTheRecordedCovarianceWhereItGrows) {
  const Matrix6d step = 1e-3 * Matrix6d::Identity();
  const Pose3 motion = planarPose(0.7, 0, 0.05);
  Drive drive;
  Pose3 pose = Pose3::Identity();
  Matrix6d covariance = 1e-6 * Matrix6d::Identity(), expected = Matrix6d::Zero();
  for (int i = 0; i <= 3; ++i) {
    drive.observe(robotPose(kStart + i, pose, covariance));
    drive.observe(cloud(kStart + i, somePoints()));
    pose = pose * motion;
    covariance = composeCovariance(covariance, motion, step);
    if (i < 3) expected = composeCovariance(expected, motion, step);
  }
  drive.finish();
  ASSERT_EQ(drive.packets.size(), 2u);
  EXPECT_LT((drive.packets[1].odometry->covariance - expected).norm(), 1e-5 * expected.norm());
}

double sigmaM(const KeyNodePacket& packet) {
  return std::sqrt(packet.odometry->covariance(0, 0));
}

TEST(FrontEnd, DropsScansBeforeOdometryBeginsAndWithinItsGaps) {
  Drive drive;
  for (int i = 0; i < 600; ++i) {
    const double t = 0.1 * i;
    if (t > 10 && (t < 30 || t > 45)) drive.observe(wheels(kStart + t, t));
    drive.observe(cloud(kStart + t + 0.01, somePoints()));
  }
  drive.finish();
  size_t before = 0, within = 0;
  for (const double stamp : drive.stamps()) {
    before += stamp < kStart + 9.5 ? 1 : 0;
    within += stamp > kStart + 30.6 && stamp < kStart + 44.4 ? 1 : 0;
  }
  EXPECT_EQ(before, 0u);
  EXPECT_EQ(within, 0u);
  EXPECT_NEAR(static_cast<double>(drive.front_end.counts().without_odometry), 95 + 140, 5);
  for (size_t k = 1; k < drive.packets.size(); ++k) {
    const bool over_gap =
        drive.packets[k - 1].stamp < kStart + 31 && drive.packets[k].stamp > kStart + 44;
    EXPECT_EQ(sigmaM(drive.packets[k]) > 0.5, over_gap) << drive.packets[k].stamp - kStart;
  }
  EXPECT_THAT(drive.front_end.warnings(), ElementsAre(HasSubstr("has gaps")));
}

/** 20 s at 0.5 m/s with five scans a second, in which odometry says x(t).
 *  \param moves whether the robot does what it says while it drives. */
template <class Says>
void driveInHall(Drive& drive, Says says, double seconds, bool moves) {
  for (int i = 0; 0.2 * i < seconds; ++i) {
    const double t = 0.2 * i;
    drive.observe(wheels(kStart + t, says(t)));
    drive.observe(cloud(kStart + t, hallSeenFrom(moves ? 0.5 * t : says(t), 0)));
  }
  drive.finish();
}

TEST(FrontEnd, LeavesOutWhatTheLidarSeesWhileOdometryHasFailed) {
  Drive drive;  // stands from 8 to 20 s only for odometry, which then goes on
  driveInHall(
      drive, [](double t) { return t < 8    ? 0.5 * t
                                   : t < 20 ? 4.0
                                            : 0.5 * (t - 12); }, 26, true);
  EXPECT_GT(drive.front_end.counts().contradicted, 50u);
  EXPECT_THAT(drive.front_end.warnings(), ElementsAre(HasSubstr("scans were dropped: they show")));
  for (const double stamp : drive.stamps())
    EXPECT_FALSE(stamp > kStart + 8.3 && stamp < kStart + 19.9) << stamp - kStart;
  const auto first = std::find_if(drive.packets.begin(), drive.packets.end(),
                                  [](const auto& packet) { return packet.stamp > kStart + 19; });
  ASSERT_NE(first, drive.packets.end());
  EXPECT_GT(sigmaM(*first), 3.0) << "it moved 6 m that nobody measured";
  EXPECT_LT(sigmaM(*std::next(first)), 0.1);
}

TEST(FrontEnd, BelievesOdometryWhereTheRobotReallyStands) {
  Drive drive;
  driveInHall(
      drive, [](double t) { return t < 8    ? 0.5 * t
                                   : t < 20 ? 4.0
                                            : 0.5 * (t - 12); }, 26, false);
  EXPECT_EQ(drive.front_end.counts().contradicted, 0u);
  EXPECT_THAT(drive.front_end.warnings(), IsEmpty());
}

TEST(FrontEnd, PeopleWhoPassAStandingRobotDoNotMoveIt) {
  Drive drive;
  for (int i = 0; i < 100; ++i) {
    auto points = hallSeenFrom(0, 0);
    for (size_t k = 0; k < points.size(); ++k)  // a third of the view, nearer from scan to scan
      if (k % 360 < 120) points[k] *= 0.3f + 0.006f * static_cast<float>(i);
    drive.observe(wheels(kStart + 0.2 * i, 0));
    drive.observe(cloud(kStart + 0.2 * i, points));
  }
  drive.finish();
  EXPECT_EQ(drive.front_end.counts().contradicted, 0u);
}

/** Specific force of a robot at rest, as a unit tells it that is mounted with this roll. */
void restWithImu(Drive& drive, double roll_deg) {
  for (int i = 0; i < 200; ++i) {
    auto imu = mrpt::obs::CObservationIMU::Create();
    for (const auto field :
         {mrpt::obs::IMU_X_ACC, mrpt::obs::IMU_WX, mrpt::obs::IMU_WY, mrpt::obs::IMU_WZ})
      imu->set(field, 0);
    imu->set(mrpt::obs::IMU_Y_ACC, 9.81 * std::sin(roll_deg * kDegree));
    imu->set(mrpt::obs::IMU_Z_ACC, 9.81 * std::cos(roll_deg * kDegree));
    drive.observe(wrapped(kStart + 0.02 * i, "imu", imu));
    drive.observe(wheels(kStart + 0.02 * i, 0));
  }
  drive.observe(cloud(kStart + 3.9, somePoints()));
  drive.observe(wheels(kStart + 4, 0));
  drive.finish();
}

TEST(FrontEnd, AnInertialUnitThatContradictsTheStartPoseIsNotBelieved) {
  StartPrior prior;
  prior.covariance = 0.002 * Matrix6d::Identity();
  for (const double roll : {0.0, 5.0, 25.0, 90.0, 180.0}) {
    Drive drive({}, prior);
    restWithImu(drive, roll);
    ASSERT_EQ(drive.packets.size(), 1u);
    EXPECT_EQ(drive.packets[0].extras.gravity.has_value(), roll < 15) << roll;
    if (roll > 15)
      EXPECT_THAT(drive.front_end.warnings(),
                  ElementsAre(AllOf(HasSubstr("inertial unit is not used"),
                                    HasSubstr(std::to_string(static_cast<int>(roll)) + " deg"))));
    else
      EXPECT_THAT(drive.front_end.warnings(), IsEmpty());
  }
}

/** Whether key nodes are planar that were seen with these sensors. */
bool planarWith(const std::vector<InputObservation>& observations) {
  Drive drive;
  for (const InputObservation& observation : observations) drive.observe(observation);
  drive.finish();
  EXPECT_EQ(drive.packets.size(), 1u);
  return drive.packets.at(0).planar;
}

TEST(FrontEnd, IsPlanarWithALevelLaserThatStaysInThePlane) {
  EXPECT_TRUE(planarWith({wheels(kStart, 0), laser(kStart)}));
  EXPECT_TRUE(planarWith({wheels(kStart, 0), laser(kStart, 1)}));
  EXPECT_FALSE(planarWith({wheels(kStart, 0), laser(kStart, 10)})) << "a tilted laser";
  EXPECT_TRUE(planarWith({wheels(kStart, 0), laser(kStart, 0, 180)})) << "upside down";
  EXPECT_FALSE(planarWith({wheels(kStart, 0), laser(kStart, 0, 90)}));
  EXPECT_TRUE(planarWith({robotPose(kStart, Pose3::Identity()), laser(kStart)}));
  const Pose3 slope = expSE3(tangent(1, 0, 0, 0, 0.2, 0));
  EXPECT_FALSE(planarWith(
      {robotPose(kStart - 1, Pose3::Identity()), robotPose(kStart, slope), laser(kStart)}));
  EXPECT_FALSE(planarWith({wheels(kStart, 0), cloud(kStart, somePoints())}));
}

TEST(FrontEnd, APlanarRobotStaysInThePlaneOfItsFirstPose) {
  Drive drive;
  const Pose3 start = expSE3(tangent(3, 4, 1.5, 0, 0, 0.7));
  for (int i = 0; i < 4; ++i) {
    drive.observe(robotPose(kStart + i, start * expSE3(tangent(3 * i, 0, 0.01 * i, 0.01, 0, 0))));
    drive.observe(laser(kStart + i));
  }
  drive.finish();
  ASSERT_EQ(drive.packets.size(), 4u);
  for (const KeyNodePacket& packet : drive.packets) {
    EXPECT_TRUE(packet.planar);
    EXPECT_NEAR(packet.odom_T_base.translation().z(), 1.5, 1e-5);
    if (packet.odometry) {
      const Pose3& motion = packet.odometry->previous_T_this;
      EXPECT_LT((motion.matrix() - projectToPlane(motion).matrix()).norm(), 1e-9);
    }
  }
}

TEST(FrontEnd, IsNotPlanarIfAnotherLidarSeesMore) {
  Drive drive;
  for (int i = 0; i < 2; ++i) {
    drive.observe(wheels(kStart + i, 3.0 * i));
    drive.observe(laser(kStart + i));
    drive.observe(wheels(kStart + i + 0.85, 3.0 * i + 2.5));
    drive.observe(cloud(kStart + i + 0.9, somePoints()));
  }
  drive.finish();
  ASSERT_EQ(drive.packets.size(), 2u);
  ASSERT_EQ(drive.packets[1].scan->sensors.size(), 2u);
  EXPECT_FALSE(drive.packets[1].planar);
}

TEST(FrontEnd, ATiltedLaserIsTold) {
  Drive drive;
  for (int i = 0; i < 3; ++i) {
    drive.observe(wheels(kStart + i, 3.0 * i));
    drive.observe(laser(kStart + i, 25));
  }
  drive.finish();
  EXPECT_EQ(drive.packets.size(), 3u);
  EXPECT_THAT(drive.front_end.warnings(),
              ElementsAre(AllOf(HasSubstr("'laser' is tilted by 25 deg"), HasSubstr("in space"))));
}

TEST(FrontEnd, AStandstillMakesNoKeyNodesAndTakesNoMemory) {
  Drive drive;
  for (int i = 0; i < 5000; ++i) {
    drive.observe(wheels(kStart + 0.1 * i, 0));
    drive.observe(cloud(kStart + 0.1 * i, somePoints()));
  }
  drive.finish();
  EXPECT_EQ(drive.packets.size(), 1u);
  EXPECT_LT(drive.end.passed_scans.size(), 200u);
  EXPECT_NEAR(drive.end.passed_scans.back().stamp, kStart + 499.9, 1e-3);
}

FrontEndOptions keyedOptions() {
  FrontEndOptions options;
  options.keyed = true;
  return options;
}

TEST(FrontEndKeyed, EveryStampIsAKeyNodeWithAllItsClouds) {
  Drive drive(keyedOptions());
  for (int i = 0; i < 3; ++i) {
    const double t = kStart + i;
    const std::vector<InputObservation> observations = {
        cloud(t, {{4, 0, 0}}, "front", {0.3, 0, 0.5}), wheels(t, 0.1 * i),
        cloud(t, {{-6, 1, 0}, {-7, 1, 0}}, "rear", {-0.4, 0, 0.6})};
    for (int k = 0; k < 3; ++k) drive.observe(observations[(i + k) % 3]);  // in any order
  }
  drive.finish();
  ASSERT_EQ(drive.packets.size(), 3u) << "though the robot hardly moves";
  for (size_t i = 0; i < 3; ++i) {
    const KeyNodePacket& packet = drive.packets[i];
    EXPECT_NEAR(packet.stamp, kStart + static_cast<double>(i), 1e-6);
    EXPECT_NEAR(packet.odom_T_base.translation().x(), 0.1 * static_cast<double>(i), 1e-6);
    EXPECT_THAT(packet.passed_scans, IsEmpty());
    ASSERT_EQ(packet.scan->size(), 3u);
    ASSERT_EQ(packet.scan->sensors.size(), 2u);
    const size_t front = packet.scan->sensors[0].label == "front" ? 0 : 1;
    const SensorOrigin &a = packet.scan->sensors[front], &b = packet.scan->sensors[1 - front];
    EXPECT_TRUE(a.position.isApprox(Eigen::Vector3d(0.3, 0, 0.5), 1e-6));
    EXPECT_EQ(b.label, "rear");
    EXPECT_TRUE(b.position.isApprox(Eigen::Vector3d(-0.4, 0, 0.6), 1e-6));
    EXPECT_EQ(std::count(packet.scan->sensor.begin(), packet.scan->sensor.end(), front), 1);
  }
  EXPECT_THAT(drive.end.passed_scans, IsEmpty());
  EXPECT_EQ(drive.front_end.counts().scans, 3u);
  EXPECT_THAT(drive.front_end.warnings(), IsEmpty());
}

TEST(FrontEndKeyed, PointsStayAsTheyAre) {
  FrontEndOptions options = keyedOptions();
  options.scan.min_range_m = 1;
  options.scan.max_range_m = 10;
  options.voxel.target_points = 1;
  std::vector<Eigen::Vector3f> points;
  for (int i = 0; i < 500; ++i) points.emplace_back(0.01f * static_cast<float>(i + 1), 0.5f, 0.1f);
  points.emplace_back(50.0f, 0.0f, 0.0f);
  const float nan = std::nanf("");
  std::vector<Eigen::Vector3f> recorded = points;
  recorded.emplace_back(nan, 1.0f, 1.0f);
  Drive drive(options);
  drive.observe(wheels(kStart, 0));
  drive.observe(cloud(kStart, recorded));
  drive.finish();
  ASSERT_EQ(drive.packets.size(), 1u);
  EXPECT_EQ(drive.packets[0].scan->points, points) << "all but what is no number";
}

TEST(FrontEndKeyed, AStampWithoutPointsIsNoKeyNode) {
  Drive drive(keyedOptions());
  for (int i = 0; i < 3; ++i) {
    drive.observe(wheels(kStart + i, 3.0 * i));
    drive.observe(cloud(kStart + i, {}, "front"));
    drive.observe(
        cloud(kStart + i, i == 1 ? std::vector<Eigen::Vector3f>{} : somePoints(), "rear"));
  }
  drive.finish();
  ASSERT_EQ(drive.packets.size(), 2u);
  EXPECT_EQ(drive.packets[1].passed_scans.size(), 1u);
  EXPECT_EQ(drive.packets[1].scan->sensors.size(), 2u) << "an empty cloud keeps its sensor";
  EXPECT_THAT(drive.front_end.warnings(), ElementsAre(HasSubstr("1 scans had no usable point")));
}

TEST(FrontEndKeyed, TheCovarianceIsTheRecordedOneOrTheMotionModels) {
  const Matrix6d step = 1e-3 * Matrix6d::Identity();
  const Pose3 motion = planarPose(2.5, 0, 0.05);
  const auto edge = [&](bool growing) {
    Drive drive(keyedOptions());
    Pose3 pose = Pose3::Identity();
    Matrix6d covariance = 1e-6 * Matrix6d::Identity();
    for (int i = 0; i < 2; ++i) {
      drive.observe(cloud(kStart + i, somePoints()));
      drive.observe(robotPose(kStart + i, pose, growing ? covariance : Matrix6d::Zero()));
      pose = pose * motion;
      covariance = composeCovariance(covariance, motion, step);
    }
    drive.finish();
    EXPECT_EQ(drive.packets.size(), 2u);
    EXPECT_THAT(drive.front_end.warnings(), IsEmpty()) << "zero is recorded where it is unknown";
    return drive.packets.back().odometry->covariance;
  };
  EXPECT_LT((edge(true) - step).norm(), 1e-5 * step.norm());
  Path path;
  path.add(motion);
  EXPECT_LT((edge(false) - odometryCovariance(path, {})).norm(), 1e-9);
}

}  // namespace
}  // namespace lamp
