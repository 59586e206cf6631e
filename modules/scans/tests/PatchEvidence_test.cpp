#include "lamp/scans/PatchEvidence.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace lamp {
namespace {

using Eigen::Vector3f;

/** A wall of 6 x 2 m, 5 m ahead, seen from the origin; and a box of 1 x 1 m before it, 3 m ahead.
 */
PreparedScanPtr wall(bool with_box, float ahead = 5.0f) {
  constexpr float kSpacing = 0.2f;
  std::vector<Vector3f> points;
  const auto isBehindBox = [&](float y, float z) {
    return with_box && std::abs(y) * 3 < 0.5f * ahead && std::abs(z) * 3 < 0.5f * ahead;
  };
  for (float y = -3; y <= 3; y += kSpacing)
    for (float z = -1; z <= 1; z += kSpacing)
      if (!isBehindBox(y, z)) points.emplace_back(ahead, y, z);
  if (with_box)
    for (float y = -0.45f; y <= 0.5f; y += 0.15f)
      for (float z = -0.45f; z <= 0.5f; z += 0.15f) points.emplace_back(3.0f, y, z);
  return prepareScan(std::move(points), 8, false);
}

TEST(PatchEvidence, EqualScansAgree) {
  const PatchEvidence evidence = patchEvidence(*wall(true), *wall(true), Pose3::Identity());
  EXPECT_GE(evidence.agreeing.size(), 12u) << "the wall is 12 square metres";
  EXPECT_TRUE(evidence.contradicting.empty());
  EXPECT_TRUE(std::is_sorted(evidence.agreeing.begin(), evidence.agreeing.end()));
}

TEST(PatchEvidence, WhatRaysPassedThroughContradicts) {
  const PatchEvidence of_box = patchEvidence(*wall(true), *wall(false), Pose3::Identity());
  EXPECT_FALSE(of_box.contradicting.empty());
  for (const Patch& patch : of_box.contradicting)
    EXPECT_EQ(patch[0], 3) << "only the box lies before the wall";
  const PatchEvidence of_wall = patchEvidence(*wall(false), *wall(true), Pose3::Identity());
  EXPECT_TRUE(of_wall.contradicting.empty()) << "what lies behind the box was not seen";
}

TEST(PatchEvidence, AWallMovedAwayContradictsOnlyWhereItIsNearer) {
  const PatchEvidence nearer = patchEvidence(*wall(false, 4), *wall(false, 6), Pose3::Identity());
  EXPECT_TRUE(nearer.agreeing.empty());
  EXPECT_GE(nearer.contradicting.size(), 8u);
  const PatchEvidence farther = patchEvidence(*wall(false, 6), *wall(false, 4), Pose3::Identity());
  EXPECT_TRUE(farther.agreeing.empty());
  EXPECT_TRUE(farther.contradicting.empty());
}

TEST(PatchEvidence, FollowsThePose) {
  const PatchEvidence evidence =
      patchEvidence(*wall(false, 4), *wall(false, 6), Pose3(Eigen::Translation3d(2, 0, 0)));
  EXPECT_GE(evidence.agreeing.size(), 12u);
  EXPECT_TRUE(evidence.contradicting.empty());
}

TEST(PatchEvidence, EmptyScansSayNothing) {
  const PreparedScanPtr nothing = prepareScan({}, 8, false);
  for (const auto& evidence : {patchEvidence(*nothing, *wall(true), Pose3::Identity()),
                               patchEvidence(*wall(true), *nothing, Pose3::Identity())}) {
    EXPECT_TRUE(evidence.agreeing.empty());
    EXPECT_TRUE(evidence.contradicting.empty());
  }
}

}  // namespace
}  // namespace lamp
