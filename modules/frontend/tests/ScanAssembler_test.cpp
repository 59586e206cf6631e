#include "lamp/frontend/ScanAssembler.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "TestObservations.h"

namespace lamp {
namespace {

using namespace test;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

InputObservation scan(double t, const std::string& label) {
  return cloud(kStart + t, somePoints(), label);
}

/** `stamp: labels` of a scan, and what says that there is none. */
std::string text(const std::optional<ScanParts>& parts) {
  if (!parts) return "none";
  std::string result = std::to_string(static_cast<int>(parts->stamp - kStart)) + ":";
  for (const InputObservation& part : parts->observations) result += " " + part.label;
  return result;
}

TEST(ReferenceLidarScans, JoinsTheLatestOfOtherLidars) {
  ReferenceLidarScans scans(1.5);
  EXPECT_EQ(text(scans.observe(scan(0, "front"))), "0: front") << "the first one is the reference";
  EXPECT_EQ(text(scans.observe(scan(1, "rear"))), "none");
  EXPECT_EQ(text(scans.observe(scan(2, "rear"))), "none");
  EXPECT_EQ(text(scans.observe(wheels(kStart + 2, 0))), "none");
  EXPECT_EQ(text(scans.observe(scan(3, "front"))), "3: front rear");
  EXPECT_EQ(text(scans.observe(scan(4, "front"))), "4: front") << "rear is too old";
  EXPECT_EQ(text(scans.finish()), "none");
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
