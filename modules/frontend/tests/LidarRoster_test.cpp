#include "LidarRoster.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "TestObservations.h"

namespace lamp {
namespace {

using namespace test;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

const Eigen::Vector3d kFront(0.4, 0, 0.6), kRear(-0.4, 0, 0.6), kTop(0, 0, 0.9);

InputObservation scanOf(const std::string& label, double t, const Eigen::Vector3d& base_p_lidar) {
  return cloud(kStart + t, somePoints(), label, base_p_lidar);
}

TEST(LidarRoster, SaysNothingOfLidarsThatAreAllRight) {
  LidarRoster roster;
  for (int i = 0; i < 100; ++i) {
    EXPECT_EQ(roster.take(scanOf("front", 0.1 * i, kFront)).label, "front");
    EXPECT_EQ(roster.take(scanOf("rear", 0.1 * i + 0.03, kRear)).label, "rear");
    EXPECT_EQ(roster.take(wheels(kStart + 0.1 * i + 0.05, 0)).label, "wheels");
  }
  EXPECT_THAT(roster.warnings(), IsEmpty());
}

TEST(LidarRoster, TellsLidarsThatShareALabelApart) {
  LidarRoster roster;
  std::multiset<std::string> names;
  for (int i = 0; i < 50; ++i) {
    EXPECT_EQ(roster.take(scanOf("lidar", 0.1 * i, kFront)).label, "lidar");
    names.insert(roster.take(scanOf("lidar", 0.1 * i + 0.03, kRear)).label);
    names.insert(roster.take(scanOf("lidar", 0.1 * i + 0.06, kTop)).label);
  }
  EXPECT_GE(names.count("lidar 2"), 45u);
  EXPECT_GE(names.count("lidar 3"), 45u);
  EXPECT_THAT(roster.warnings(), ElementsAre(HasSubstr("3 lidars have the label 'lidar'")));
}

TEST(LidarRoster, ALidarOnAMountThatMovesIsOne) {
  LidarRoster turning, nodding, moved;
  for (int i = 0; i < 200; ++i) {
    const double angle = 0.1 * i;
    EXPECT_EQ(
        turning.take(scanOf("lidar", 0.1 * i, {0.1 * std::cos(angle), 0.1 * std::sin(angle), 0.7}))
            .label,
        "lidar");
    InputObservation scan = scanOf("laser", 0.1 * i, kTop);
    scan.observation->setSensorPose(mrpt::poses::CPose3D(0, 0, 0.9, 0, i % 2 ? 0.3 : -0.3, 0));
    EXPECT_EQ(nodding.take(scan).label, "laser");
    EXPECT_EQ(moved.take(scanOf("lidar", 0.1 * i, i < 100 ? kFront : kRear)).label, "lidar")
        << "it was mounted anew, or calibrated";
  }
  for (const LidarRoster* roster : {&turning, &nodding, &moved})
    EXPECT_THAT(roster->warnings(), IsEmpty());
}

TEST(LidarRoster, SaysOnceThatExtrinsicsAreMissing) {
  LidarRoster roster;
  for (int i = 0; i < 20; ++i) {
    double t = 0.1 * i;
    for (const char* label : {"front", "rear", "top"})
      roster.take(scanOf(label, t += 0.03, Eigen::Vector3d::Zero()));
  }
  EXPECT_THAT(roster.warnings(),
              ElementsAre(AllOf(HasSubstr("'front', 'rear' and 'top'"), HasSubstr("sensorPose"))));
}

TEST(LidarRoster, OneLidarInTheBasesOriginIsNoFault) {
  LidarRoster roster;
  roster.take(scanOf("front", 0, Eigen::Vector3d::Zero()));
  EXPECT_THAT(roster.warnings(), IsEmpty());
}

/** \param silent whether the lidar is, at t; the wheels never are, unless all pause. */
template <class Silent>
std::vector<std::string> warningsOf(Silent silent, bool all = false) {
  LidarRoster roster;
  for (int i = 0; i < 400; ++i) {
    const double t = 0.1 * i;
    if (!silent(t)) roster.take(scanOf("front", t, kFront));
    if (!all || !silent(t)) roster.take(wheels(kStart + t + 0.05, 0));
  }
  return roster.warnings();
}

TEST(LidarRoster, SaysForHowLongALidarWasSilent) {
  const auto pauses = [](double t) { return (t > 9.95 && t < 14.95) || (t > 20.05 && t < 24.05); };
  EXPECT_THAT(warningsOf(pauses),
              ElementsAre(AllOf(HasSubstr("gives nothing for 9."), HasSubstr("1600000009.900"))));
  EXPECT_THAT(warningsOf([](double t) { return t > 30; }),
              ElementsAre(AllOf(HasSubstr("gives nothing for"), HasSubstr("1600000030.000"))));
  EXPECT_THAT(warningsOf([](double t) { return t > 20 && t < 21.5; }), IsEmpty());
}

TEST(LidarRoster, ASensorWithAnotherClockIsNoSilence) {
  for (const double offset : {-300.0, -5.0, 5.0, 300.0}) {
    LidarRoster roster;
    for (int i = 0; i < 400; ++i) {
      roster.take(scanOf("front", 0.1 * i, kFront));
      roster.take(wheels(kStart + 0.1 * i + offset, 0));
    }
    EXPECT_THAT(roster.warnings(), IsEmpty()) << offset;
  }
}

TEST(LidarRoster, APauseOfTheRecordingIsNoSilence) {
  EXPECT_THAT(warningsOf([](double t) { return t > 10 && t < 20; }, true), IsEmpty());
}

}  // namespace
}  // namespace lamp
