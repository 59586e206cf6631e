#include "lamp/core/VoxelSet.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <set>
#include <stdexcept>
#include <tuple>

namespace lamp {
namespace {

TEST(VoxelSet, AgreesWithASetOfCells) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> coordinate(-4, 4);
  VoxelSet voxels(0.25);
  std::set<std::tuple<int, int, int>> cells;
  for (int i = 0; i < 50000; ++i) {
    const Eigen::Vector3d p(coordinate(random), coordinate(random), coordinate(random));
    const auto cell = [&](int axis) { return static_cast<int>(std::floor(p[axis] * 4)); };
    ASSERT_EQ(voxels.insert(p), cells.insert({cell(0), cell(1), cell(2)}).second);
  }
  EXPECT_EQ(voxels.size(), cells.size());
}

TEST(VoxelSet, RefusesPointsThatTheGridCannotNumber) {
  VoxelSet voxels(0.001);
  EXPECT_TRUE(voxels.insert({-1048.0, 1048.0, 0}));
  EXPECT_THROW(voxels.insert({1049.0, 0, 0}), std::runtime_error);
  EXPECT_THROW(voxels.insert({std::nan(""), 0, 0}), std::runtime_error);
}

}  // namespace
}  // namespace lamp
