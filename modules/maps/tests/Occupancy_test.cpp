#include "lamp/maps/Occupancy.h"

#include <gtest/gtest.h>

#include "OccupiedSpace.h"
#include "TestGround.h"

namespace lamp {
namespace {

TEST(Occupancy, IsMadeOnceForAllWhoAskForTheSameMap) {
  TestMap test;
  hall().drive({{1, 0, 0.05}, {3, 0, 0.05}}, test);
  Occupancy occupancy;
  const VoxelStates* const states = &occupancy.of(test.map).states();
  const Storey* const storeys = occupancy.of(test.map).storeys().data();
  const ComponentMap copy = test.map;
  EXPECT_EQ(&occupancy.of(copy).states(), states);
  EXPECT_EQ(occupancy.of(copy).storeys().data(), storeys);
}

/** Whatever changes, the answer is that of an occupancy that was asked nothing before. */
TEST(Occupancy, FollowsTheMap) {
  TestMap test, empty;
  hall().drive({{1, 0, 0.05}, {3, 0, 0.05}}, test);
  Occupancy occupancy;
  const auto expectFresh = [&](const ComponentMap& map) {
    Occupancy fresh;
    EXPECT_EQ(occupancy.of(map).states(), fresh.of(map).states());
    EXPECT_EQ(occupancy.of(map).storeys().at(0).cells.size(),
              fresh.of(map).storeys().at(0).cells.size());
  };
  expectFresh(test.map);
  test.map.key_nodes.back().world_T_base.pretranslate(Eigen::Vector3d(0.5, 0, 0));
  expectFresh(test.map);
  test.map.tracks.clear();  // of the scans nothing changed
  expectFresh(test.map);
  expectFresh(empty.map);
  EXPECT_TRUE(occupancy.of(empty.map).states().empty());
  expectFresh(test.map);
}

}  // namespace
}  // namespace lamp
