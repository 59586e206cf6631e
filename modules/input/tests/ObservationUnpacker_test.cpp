#include "ObservationUnpacker.h"

#include <gtest/gtest.h>
#include <mrpt/obs/CActionRobotMovement2D.h>
#include <mrpt/obs/CActionRobotMovement3D.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/CObservationRobotPose.h>

#include "RecordingTools.h"

namespace lamp {
namespace {

using namespace test;
using mrpt::obs::CActionCollection;
using mrpt::obs::CActionRobotMovement2D;
using mrpt::obs::CActionRobotMovement3D;
using mrpt::obs::CObservation;
using mrpt::obs::CObservationOdometry;
using mrpt::obs::CObservationRobotPose;

CActionCollection::Ptr drive(double x, double phi, double stamp = 0) {
  CActionRobotMovement2D action;
  action.computeFromOdometry(mrpt::poses::CPose2D(x, 0, phi), {});
  if (stamp > 0) action.timestamp = mrpt::Clock::fromDouble(stamp);
  auto actions = CActionCollection::Create();
  actions->insert(action);
  return actions;
}

mrpt::obs::CSensoryFrame::Ptr frame(const std::vector<CObservation::Ptr>& observations) {
  auto result = mrpt::obs::CSensoryFrame::Create();
  for (const auto& o : observations) result->insert(o);
  return result;
}

std::vector<CObservation::Ptr> unpack(ObservationUnpacker& unpacker, const Objects& objects) {
  for (const auto& object : objects) unpacker.push(object);
  unpacker.finish();
  std::vector<CObservation::Ptr> result;
  while (auto o = unpacker.pop()) result.push_back(o);
  return result;
}

double stampOf(const CObservation& o) {
  return mrpt::Clock::toDouble(o.timestamp);
}

TEST(ObservationUnpacker, SumsUpPlanarIncrements) {
  ObservationUnpacker unpacker;
  const auto out = unpack(unpacker, {drive(1, M_PI / 2), frame({cloud(10, "laser")}), drive(2, 0),
                                     frame({cloud(11, "laser"), cloud(11.1, "other")})});
  ASSERT_EQ(out.size(), 5u);
  const auto first = std::dynamic_pointer_cast<CObservationOdometry>(out[0]);
  const auto second = std::dynamic_pointer_cast<CObservationOdometry>(out[2]);
  ASSERT_TRUE(first && second);
  EXPECT_EQ(first->sensorLabel, "odometry");
  EXPECT_EQ(stampOf(*first), 10);
  EXPECT_NEAR(first->odometry.x(), 1, 1e-12);
  // 1 m ahead, a quarter turn left, 2 m ahead.
  EXPECT_EQ(stampOf(*second), 11);
  EXPECT_NEAR(second->odometry.x(), 1, 1e-12);
  EXPECT_NEAR(second->odometry.y(), 2, 1e-12);
  EXPECT_NEAR(second->odometry.phi(), M_PI / 2, 1e-12);
  EXPECT_EQ(out[4]->sensorLabel, "other");
}

TEST(ObservationUnpacker, StartsAtTheFrameBeforeTheFirstAction) {
  ObservationUnpacker unpacker;
  const auto out = unpack(
      unpacker, {frame({cloud(10, "r1/laser")}), drive(3, 0), frame({cloud(11, "r1/laser")})});
  ASSERT_EQ(out.size(), 4u);
  const auto first = std::dynamic_pointer_cast<CObservationOdometry>(out[0]);
  ASSERT_TRUE(first);
  EXPECT_EQ(first->sensorLabel, "r1/odometry");
  EXPECT_EQ(stampOf(*first), 10);
  EXPECT_EQ(first->odometry.x(), 0);
  EXPECT_NEAR(std::dynamic_pointer_cast<CObservationOdometry>(out[2])->odometry.x(), 3, 1e-12);
}

TEST(ObservationUnpacker, MakesUpNoOdometryWithoutActions) {
  ObservationUnpacker unpacker;
  const auto out = unpack(unpacker, {frame({cloud(1, "laser")}), frame({}),
                                     CActionCollection::Create(), frame({cloud(2, "laser")})});
  ASSERT_EQ(out.size(), 2u);
  EXPECT_EQ(stampOf(*out[1]), 2);
}

TEST(ObservationUnpacker, SumsUpSpatialIncrements) {
  CActionRobotMovement3D action;
  action.poseChange.mean = mrpt::poses::CPose3D(1, 0, 0.5, 0, 0, M_PI / 2);
  auto actions = CActionCollection::Create();
  actions->insert(action);
  ObservationUnpacker unpacker;
  const auto out =
      unpack(unpacker, {actions, frame({cloud(1, "l")}), actions, frame({cloud(2, "l")})});
  ASSERT_EQ(out.size(), 4u);
  const auto pose = std::dynamic_pointer_cast<CObservationRobotPose>(out[2]);
  ASSERT_TRUE(pose);
  // The second step's z points along -y after the quarter roll.
  EXPECT_NEAR(pose->pose.mean.x(), 2, 1e-12);
  EXPECT_NEAR(pose->pose.mean.y(), -0.5, 1e-12);
  EXPECT_NEAR(pose->pose.mean.z(), 0.5, 1e-12);
}

TEST(ObservationUnpacker, PrefersWheelsAmongSeveralEstimates) {
  CActionRobotMovement2D matched, wheel;
  matched.computeFromOdometry(mrpt::poses::CPose2D(9, 0, 0), {});
  matched.estimationMethod = CActionRobotMovement2D::emScan2DMatching;
  wheel.computeFromOdometry(mrpt::poses::CPose2D(1, 0, 0), {});
  auto both = CActionCollection::Create();
  both->insert(matched);
  auto only_matched = CActionCollection::Create(*both);
  both->insert(wheel);
  ObservationUnpacker unpacker;
  const auto out =
      unpack(unpacker, {both, frame({cloud(1, "l")}), only_matched, frame({cloud(2, "l")})});
  ASSERT_EQ(out.size(), 4u);
  EXPECT_NEAR(std::dynamic_pointer_cast<CObservationOdometry>(out[0])->odometry.x(), 1, 1e-9);
  EXPECT_NEAR(std::dynamic_pointer_cast<CObservationOdometry>(out[2])->odometry.x(), 10, 1e-9);
}

TEST(ObservationUnpacker, MissingStampsComeFromTheActionOrTheObservationIsDropped) {
  auto lost = cloud(1, "laser"), saved = cloud(1, "laser");
  lost->timestamp = saved->timestamp = INVALID_TIMESTAMP;
  ObservationUnpacker unpacker;
  const auto out = unpack(unpacker, {frame({lost}), drive(1, 0, 7.0), frame({saved})});
  ASSERT_EQ(out.size(), 2u);
  EXPECT_EQ(stampOf(*out[0]), 7.0);
  EXPECT_EQ(stampOf(*out[1]), 7.0);
  EXPECT_EQ(unpacker.withoutStamp(), 1u);
}

TEST(ObservationUnpacker, LastActionWithoutFrameKeepsItsOwnStamp) {
  ObservationUnpacker unpacker;
  const auto out = unpack(unpacker, {frame({cloud(1, "l")}), drive(1, 0), drive(1, 0, 5.0)});
  ASSERT_EQ(out.size(), 3u);
  EXPECT_EQ(stampOf(*out[2]), 5.0);
  EXPECT_NEAR(std::dynamic_pointer_cast<CObservationOdometry>(out[2])->odometry.x(), 2, 1e-12);
}

}  // namespace
}  // namespace lamp
