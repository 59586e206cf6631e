#include "OccupancyMap.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "OctreeFile.h"
#include "TestRays.h"

namespace lamp {
namespace {

/** A robot that drives through a hall with pillars. */
TestMap* hall() {
  RayWorld world;
  world.addBox({-3, 4, -3}, {30, 5, 3});
  world.addBox({-3, -5, -3}, {30, -4, 3});
  world.addBox({-3, -5, -3}, {30, 5, -0.8});
  for (const double x : {3.0, 9.0, 15.0}) world.poles.push_back({x, 2.0, 0.3});
  auto* test = new TestMap;
  for (int i = 0; i < 20; ++i) world.look({1.0 * i, 0.3, 0.1}, *test);
  return test;
}

class Hall : public testing::Test {
 protected:
  const std::unique_ptr<TestMap> test_{hall()};
  const ComponentMap& map_ = test_->map;

  ComponentMap part(size_t begin, size_t end) const {
    ComponentMap map = map_;
    map.key_nodes.assign(map_.key_nodes.begin() + static_cast<std::ptrdiff_t>(begin),
                         map_.key_nodes.begin() + static_cast<std::ptrdiff_t>(end));
    return map;
  }
};

/** Everything that the counts say. */
std::string bytesOf(const OccupancyMap& occupancy) {
  std::map<BlockKey, std::string> blocks;
  for (const auto& [key, block] : occupancy.counts().blocks()) {
    std::ostringstream text;
    for (size_t i = 0; i < kBlockVoxels; ++i) {
      const VoxelCounts voxel = block->at(i);
      text << block->passes(i) << " " << voxel.hits << " " << voxel.clear_passes << " "
           << voxel.hit_times << " " << voxel.clear_times << "\n";
    }
    blocks[key] = text.str();
  }
  std::string all;
  for (const auto& [key, text] : blocks) all += std::to_string(key) + "\n" + text;
  return all;
}

std::string fromNothing(const ComponentMap& map) {
  OccupancyMap occupancy({});
  occupancy.update(map);
  return bytesOf(occupancy);
}

TEST_F(Hall, TakingOutWhatWasPutInLeavesNothing) {
  OccupancyMap occupancy({});
  occupancy.update(map_);
  EXPECT_GT(occupancy.counts().blocks().size(), 100u);
  // One by one, so that none is dropped as a whole.
  for (size_t end = map_.key_nodes.size(); end-- > 0;) {
    OccupancyCounts counts;
    const MapKeyNode& key_node = map_.key_nodes[end];
    const auto evidence = [&] {
      std::vector<ScanEvidence> scans;
      scans.push_back({castRays(*key_node.scan, key_node.world_T_base, 0.2, 15), 7, true});
      return scans;
    };
    counts.add(evidence());
    EXPECT_FALSE(counts.blocks().empty());
    counts.subtract(evidence());
    EXPECT_TRUE(counts.blocks().empty());
  }
  occupancy.update(part(0, 0));
  EXPECT_TRUE(occupancy.counts().blocks().empty());
}

TEST_F(Hall, MovedScansAreExchangedAndTheCountsThoseOfAMapFromNothing) {
  OccupancyMap occupancy({});
  occupancy.update(map_);
  EXPECT_EQ(occupancy.inserted(), 20u);
  ComponentMap moved = map_;
  for (const size_t i : {3u, 4u})
    moved.key_nodes[i].world_T_base.pretranslate(Eigen::Vector3d(0.1, 0.4, 0));
  occupancy.update(moved);
  EXPECT_EQ(occupancy.removed(), 2u);
  EXPECT_EQ(occupancy.inserted(), 2u);
  EXPECT_TRUE(bytesOf(occupancy) == fromNothing(moved));
  EXPECT_FALSE(bytesOf(occupancy) == fromNothing(map_));

  occupancy.update(map_);
  EXPECT_TRUE(bytesOf(occupancy) == fromNothing(map_));
  occupancy.update(map_);
  EXPECT_EQ(occupancy.removed() + occupancy.inserted(), 0u);
}

TEST_F(Hall, GrowsKeyNodeByKeyNode) {
  OccupancyMap occupancy({});
  for (size_t end = 1; end <= map_.key_nodes.size(); ++end) {
    occupancy.update(part(0, end));
    EXPECT_EQ(occupancy.inserted(), 1u);
  }
  EXPECT_TRUE(bytesOf(occupancy) == fromNothing(map_));
  occupancy.update(part(0, 15));
  EXPECT_EQ(occupancy.removed(), 5u);
  EXPECT_TRUE(bytesOf(occupancy) == fromNothing(part(0, 15)));
}

TEST_F(Hall, WithinTheToleranceScansKeepTheirPoses) {
  OccupancyMap occupancy({0.2, 15, 0.05});
  occupancy.update(map_);
  ComponentMap moved = map_;
  moved.key_nodes[3].world_T_base.pretranslate(Eigen::Vector3d(0.03, 0, 0));
  moved.key_nodes[4].world_T_base.pretranslate(Eigen::Vector3d(0.07, 0, 0));
  moved.key_nodes[5].world_T_base.rotate(Eigen::AngleAxisd(0.01, Eigen::Vector3d::UnitZ()));
  occupancy.update(moved);
  EXPECT_EQ(occupancy.removed(), 2u);
  moved.key_nodes[3] = map_.key_nodes[3];
  EXPECT_TRUE(bytesOf(occupancy) == fromNothing(moved));
}

TEST_F(Hall, AnEarlierKeyNodeMovesTheClock) {
  OccupancyMap occupancy({});
  occupancy.update(part(5, 20));
  occupancy.update(map_);
  EXPECT_TRUE(bytesOf(occupancy) == fromNothing(map_));
}

TEST_F(Hall, LongRecordingsHaveACoarserClock) {
  ComponentMap late = map_;
  for (size_t i = 10; i < 20; ++i) late.key_nodes[i].stamp += 3e5;
  OccupancyMap occupancy({});
  occupancy.update(map_);
  occupancy.update(late);
  EXPECT_TRUE(bytesOf(occupancy) == fromNothing(late));
}

TEST_F(Hall, AnyNumberOfThreadsGivesTheSameBytes) {
  const auto bytesWith = [&](size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    OccupancyMap occupancy({});
    occupancy.update(map_);
    const VoxelSetBlocks occupied = occupiedVoxels(occupancy.counts());
    std::ostringstream file;
    writeLogOdds(classify(occupancy.counts(), occupied, {}), 0.2, "", file);
    return bytesOf(occupancy) + file.str();
  };
  EXPECT_TRUE(bytesWith(1) == bytesWith(2));
}

}  // namespace
}  // namespace lamp
