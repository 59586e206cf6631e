#include "PassedScans.h"

#include <gtest/gtest.h>

#include <random>

#include "TestObservations.h"

namespace lamp {
namespace {

using namespace test;

TEST(PassedScans, KeepsEveryScanOfARobotThatMoves) {
  PassedScans passed;
  for (int i = 0; i < 500; ++i) passed.add({kStart + i, planarPose(0.1 * i, 0, 0)});
  const auto scans = passed.take();
  ASSERT_EQ(scans.size(), 500u);
  EXPECT_EQ(scans[77].stamp, kStart + 77);
  EXPECT_TRUE(passed.take().empty());
}

TEST(PassedScans, OfAStandstillKeepsItsBeginningAndItsEnd) {
  std::mt19937 random(1);
  std::normal_distribution<double> tremble(0, 0.001);
  PassedScans passed;
  for (int i = 0; i < 10; ++i) passed.add({kStart + i, planarPose(0.1 * i, 0, 0)});
  for (int i = 10; i < 36000; ++i)
    passed.add({kStart + i, planarPose(1, tremble(random), tremble(random))});
  for (int i = 36000; i < 36010; ++i)
    passed.add({kStart + i, planarPose(1 + 0.1 * (i - 35999), 0, 0)});
  const auto scans = passed.take();
  ASSERT_LT(scans.size(), 130u);
  for (size_t i = 0; i < 60; ++i) EXPECT_EQ(scans[i].stamp, kStart + static_cast<double>(i));
  EXPECT_EQ(scans[scans.size() - 11].stamp, kStart + 35999) << "when it went on";
  EXPECT_EQ(scans.back().stamp, kStart + 36009);
}

TEST(PassedScans, ARobotThatCreepsDoesNotStand) {
  PassedScans passed;
  for (int i = 0; i < 1000; ++i) passed.add({kStart + i, planarPose(0.001 * i, 0, 0)});
  EXPECT_EQ(passed.take().size(), 1000u);
}

TEST(PassedScans, ForgetsTheLastOnes) {
  PassedScans passed;
  for (int i = 0; i < 10; ++i) passed.add({kStart + i, Pose3::Identity()});
  EXPECT_EQ(passed.dropFrom(kStart + 7), 3u);
  passed.add({kStart + 20, planarPose(1, 0, 0)});
  EXPECT_EQ(passed.take().size(), 8u);
  EXPECT_EQ(passed.dropFrom(0), 0u);
}

}  // namespace
}  // namespace lamp
