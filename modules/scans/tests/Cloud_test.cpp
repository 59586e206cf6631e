#include "lamp/scans/Cloud.h"

#include <gtest/gtest.h>

namespace lamp {
namespace {

using Eigen::Vector3f;

KeyedScanPtr scanWith(std::vector<Vector3f> points, std::vector<uint8_t> sensor,
                      std::vector<Eigen::Vector3d> positions) {
  auto scan = std::make_shared<Scan>();
  scan->points = std::move(points);
  scan->sensor = std::move(sensor);
  for (const auto& position : positions) scan->sensors.push_back({"lidar", position});
  return scan;
}

TEST(Accumulate, KeepsOrderViewpointsAndOwnPoints) {
  const auto first = scanWith({{1, 0, 0}, {2, 0, 0}}, {1, 0}, {{0, 0, 1}, {0, 0, 2}});
  const auto second = scanWith({{1, 0, 0}}, {0}, {{0, 0, 3}});
  const Pose3 turned = planarPose(10, 0, M_PI / 2);
  const Cloud cloud = accumulate({{first, Pose3::Identity()}, {second, turned}}, 0.2);
  ASSERT_EQ(cloud.size(), 3u);
  EXPECT_EQ(cloud.points[1], Vector3f(2, 0, 0));
  EXPECT_LT((cloud.points[2] - Vector3f(10, 1, 0)).norm(), 1e-5f);
  EXPECT_EQ(cloud.viewpoint, (std::vector<uint32_t>{1, 0, 2}));
  EXPECT_EQ(cloud.viewpointOf(0), Vector3f(0, 0, 2));
  EXPECT_LT((cloud.viewpointOf(2) - Vector3f(10, 0, 3)).norm(), 1e-5f);
  EXPECT_TRUE(cloud.isOwn(0) && cloud.isOwn(1));
  EXPECT_FALSE(cloud.isOwn(2));
  EXPECT_EQ(accumulate({}, 0.2).size(), 0u);
}

TEST(VoxelMeans, OneForEachCellInOrderOfFirstPoints) {
  Cloud cloud = cloudSeenFromOrigin({{1.2f, 0, 0}, {-0.2f, 0, 0}, {1.4f, 0, 0}, {-0.4f, 0, 0}});
  cloud.viewpoints.push_back({0, 0, 1});
  cloud.viewpoint = {1, 0, 0, 1};
  const Cloud means = voxelMeans(cloud, 1.0);
  ASSERT_EQ(means.size(), 2u);
  EXPECT_LT((means.points[0] - Vector3f(1.3f, 0, 0)).norm(), 1e-6f);
  EXPECT_LT((means.points[1] - Vector3f(-0.3f, 0, 0)).norm(), 1e-6f);
  EXPECT_EQ(means.viewpoint, (std::vector<uint32_t>{1, 0}));
  EXPECT_EQ(means.viewpoints.size(), 2u);
  EXPECT_EQ(voxelMeans(cloudSeenFromOrigin({}), 1.0).size(), 0u);
}

TEST(TurnTowardsViewpoints, TurnsThoseThatLookAway) {
  Cloud cloud = cloudSeenFromOrigin({{0, 0, 5}, {0, 0, 5}, {0, 0, 5}});
  cloud.viewpoints.push_back({0, 0, 9});
  cloud.viewpoint = {0, 1, 0};
  std::vector<Vector3f> normals = {{0, 0, 1}, {0, 0, 1}, {0, 0, 0}};
  turnTowardsViewpoints(cloud, normals);
  EXPECT_EQ(normals, (std::vector<Vector3f>{{0, 0, -1}, {0, 0, 1}, {0, 0, 0}}));
}

}  // namespace
}  // namespace lamp
