#include "lamp/frontend/ScanAssembler.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "TestObservations.h"

namespace lamp {
namespace {

using namespace test;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

InputObservation scan(double t, const std::string& label) {
  return cloud(kStart + t, somePoints(), label, {label == "front" ? 0.4 : -0.4, 0, 0.6});
}

/** `stamp: labels` of a scan, and what says that there is none. */
std::string text(const std::optional<ScanParts>& parts) {
  if (!parts) return "none";
  std::string result = std::to_string(static_cast<int>(parts->stamp - kStart)) + ":";
  for (const InputObservation& part : parts->observations) result += " " + part.label;
  return result;
}

std::string text(const std::vector<ScanParts>& scans) {
  std::string result;
  for (const ScanParts& parts : scans)
    result += (result.empty() ? "" : "; ") + text(std::optional(parts));
  return scans.empty() ? "none" : result;
}

TEST(ReferenceLidarScans, JoinsTheLatestOfOtherLidars) {
  ReferenceLidarScans scans(1.5, ScanOptions());
  EXPECT_EQ(text(scans.observe(scan(0, "front"))), "none") << "it may be a piece of a sweep";
  EXPECT_EQ(text(scans.observe(scan(1, "rear"))), "none");
  EXPECT_EQ(text(scans.observe(scan(2, "rear"))), "none");
  EXPECT_EQ(text(scans.observe(wheels(kStart + 2, 0))), "none");
  EXPECT_EQ(text(scans.observe(scan(3, "front"))), "0: front") << "the first one is the reference";
  EXPECT_EQ(text(scans.observe(scan(4, "front"))), "3: front rear");
  EXPECT_EQ(text(scans.observe(scan(5, "front"))), "4: front; 5: front") << "rear is too old";
  EXPECT_EQ(text(scans.finish()), "none");
}

TEST(ReferenceLidarScans, DoNotWaitOnceObservationsAreKnownToBeWholeScans) {
  ReferenceLidarScans scans(0.2, ScanOptions());
  size_t complete = 0;
  for (int i = 0; i < 10; ++i) complete += scans.observe(scan(i, "front")).size();
  EXPECT_EQ(complete, 10u);
  EXPECT_EQ(text(scans.observe(scan(10, "front"))), "10: front");
}

TEST(ReferenceLidarScans, GatherThePiecesOfASweep) {
  ReferenceLidarScans scans(0.2, ScanOptions());
  std::vector<size_t> pieces;
  for (int i = 0; i < 40; ++i) {
    const double azimuth = i * M_PI / 5;  // ten to a turn
    std::vector<Eigen::Vector3f> points;
    for (double a = azimuth; a < azimuth + 0.6; a += 0.05)
      points.emplace_back(5 * std::cos(a), 5 * std::sin(a), 0);
    for (const ScanParts& parts : scans.observe(cloud(kStart + 0.01 * i, points, "front")))
      pieces.push_back(parts.observations.size());
  }
  EXPECT_THAT(pieces, ElementsAre(10, 10, 10));
}

TEST(ReferenceLidarScans, JoinLidarsThatShareALabel) {
  ReferenceLidarScans scans(0.2, ScanOptions());
  size_t with_both = 0;
  for (int i = 0; i < 50; ++i) {
    for (const double x : {0.4, -0.4})
      for (const ScanParts& parts : scans.observe(
               cloud(kStart + 0.1 * i + (x > 0 ? 0 : 0.04), somePoints(), "lidar", {x, 0, 0.6})))
        with_both += parts.observations.size() == 2 ? 1 : 0;
  }
  EXPECT_GE(with_both, 40u);
  EXPECT_THAT(scans.warnings(), ElementsAre(HasSubstr("2 lidars have the label 'lidar'")));
}

TEST(ReferenceLidarScans, AnotherLidarTakesOverFromOneThatDies) {
  ReferenceLidarScans scans(0.2, ScanOptions());
  size_t of_front = 0, of_rear = 0;
  for (int i = 0; i < 400; ++i) {
    const double t = 0.1 * i;
    if (t < 10)
      for (const ScanParts& parts : scans.observe(scan(t, "front"))) {
        EXPECT_EQ(parts.observations[0].label, "front");
        ++of_front;
      }
    for (const ScanParts& parts : scans.observe(scan(t + 0.05, "rear"))) {
      EXPECT_EQ(parts.observations.size(), 1u);
      ++of_rear;
    }
  }
  EXPECT_EQ(of_front, 100u);
  EXPECT_NEAR(static_cast<double>(of_rear), 300 - 20, 2) << "after two seconds of silence";
  EXPECT_THAT(scans.warnings(),
              ElementsAre(AllOf(HasSubstr("'front' is silent"), HasSubstr("'rear'"))));
}

TEST(ReferenceLidarScans, ASlowLidarAndAPauseOfAllAreNoDeath) {
  ReferenceLidarScans scans(0.2, ScanOptions());
  size_t of_front = 0;
  for (int i = 0; i < 120; ++i) {
    const double t = i + (i < 60 ? 0 : 300);
    if (i % 3 == 0) of_front += scans.observe(scan(t, "front")).size();
    EXPECT_EQ(text(scans.observe(scan(t + 0.5, "rear"))), "none");
  }
  EXPECT_EQ(of_front, 40u);
  EXPECT_THAT(scans.warnings(), IsEmpty());
}

TEST(SameStampScans, AScanIsCompleteWhenTimeMovesOn) {
  SameStampScans scans;
  EXPECT_EQ(text(scans.observe(scan(0, "front"))), "none");
  EXPECT_EQ(text(scans.observe(wheels(kStart, 0))), "none") << "the same time";
  EXPECT_EQ(text(scans.observe(scan(0, "rear"))), "none");
  EXPECT_EQ(text(scans.observe(wheels(kStart + 0.5, 0))), "0: front rear");
  EXPECT_EQ(text(scans.observe(wheels(kStart + 1, 0))), "none");
  EXPECT_EQ(text(scans.observe(scan(2, "rear"))), "none");
  EXPECT_EQ(text(scans.observe(scan(3, "top"))), "2: rear");
  EXPECT_EQ(text(scans.finish()), "3: top");
  EXPECT_EQ(text(scans.finish()), "none");
  EXPECT_THAT(scans.warnings(), IsEmpty());
}

TEST(SameStampScans, AScanIsCompleteWhenOnlyTimeMovesOn) {
  SameStampScans scans;
  EXPECT_EQ(text(scans.advanceTo(kStart)), "none");
  scans.observe(scan(0, "front"));
  EXPECT_EQ(text(scans.advanceTo(kStart)), "none") << "more of that time may come";
  EXPECT_EQ(text(scans.advanceTo(kStart + 0.1)), "0: front");
  EXPECT_EQ(text(scans.advanceTo(kStart + 0.2)), "none");
}

TEST(SameStampScans, CloudsThatComeTooLateAreCounted) {
  SameStampScans scans;
  scans.observe(scan(1, "front"));
  EXPECT_EQ(text(scans.observe(scan(0, "rear"))), "none") << "earlier than the open one";
  EXPECT_EQ(text(scans.observe(wheels(kStart + 2, 0))), "1: front");
  EXPECT_EQ(text(scans.observe(scan(1, "rear"))), "none") << "its scan is gone";
  EXPECT_EQ(text(scans.finish()), "none");
  EXPECT_THAT(scans.warnings(), ElementsAre(HasSubstr("2 clouds were dropped")));
}

}  // namespace
}  // namespace lamp
