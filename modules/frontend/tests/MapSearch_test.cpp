#include "MapSearch.h"

#include <gtest/gtest.h>

#include "TestHall.h"
#include "TestObservations.h"
#include "lamp/frontend/LidarOdometry.h"

namespace lamp {
namespace {

using namespace test;

constexpr float kLeaf_m = 0.3f;
constexpr double kWide_m = 3;

/** The robot stands in the hall, which is in the map, and is thought to be farther along it. */
class MapSearch : public testing::Test {
 protected:
  MapSearch() {
    for (unsigned i = 0; i < 4; ++i) {
      const FilteredScan seen = hallSeenFrom(Pose3::Identity(), i);
      map.add(seen.points, Pose3::Identity(), seen.origin, 0);
      reference.points = seen.points;
    }
  }
  ScanToMapResult searched(double good_share) {
    return searchInMap(scan, thought, kWide_m, good_share, &reference, map);
  }
  double errorOf(const ScanToMapResult& result) const {
    return (truth.inverse() * result.map_T_scan).translation().norm();
  }

  const Pose3 truth = planarPose(0.2, 0, 0.05), thought = planarPose(2.6, 0, 0.05);
  const FilteredScan scan = hallSeenFrom(truth, 9);
  LocalMap map{kLeaf_m, false};
  LocatedScan reference;
};

TEST_F(MapSearch, WhatMatchesAsUsualIsNotSoughtElsewhere) {
  const auto nearby = registerToMap(scan.points, map, thought, 0.8);
  ASSERT_GT(errorOf(nearby), 1) << "the floor and the walls along the hall match from afar";
  EXPECT_EQ(searched(nearby.matched_share).map_T_scan.matrix(), nearby.map_T_scan.matrix());
}

TEST_F(MapSearch, WhatMatchesMuchLessThanUsualIsFoundFartherOff) {
  const auto found = searched(0.8);
  EXPECT_LT(errorOf(found), 0.03);
}

}  // namespace
}  // namespace lamp
