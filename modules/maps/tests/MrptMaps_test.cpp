// The files for MRPT's own programs, read back by MRPT.
#include <gtest/gtest.h>
#include <mrpt/maps/CSimpleMap.h>
#include <mrpt/obs/CObservationPointCloud.h>
#include <mrpt/opengl/COpenGLScene.h>
#include <mrpt/opengl/CPointCloud.h>
#include <mrpt/opengl/CSetOfLines.h>

#include "TestMaps.h"
#include "lamp/maps/Scene3d.h"
#include "lamp/maps/SimpleMap.h"

namespace lamp {
namespace {

void fill(TestMap& test) {
  const auto two_lidars = makeScan({{1, 0, 0}, {0, 2, 0}, {0, 0, 3}});
  two_lidars->sensors = {{"front", {0.5, 0, 0.2}}, {"rear", {-0.5, 0, 0.2}}};
  two_lidars->sensor = {0, 1, 1};
  test.add(0, planarPose(1, 2, 0.5), two_lidars);
  test.add(1, planarPose(4, 5, -1), makeScan({{1, 1, 1}}));
  test.add(1, planarPose(5, 5, -1), nullptr);
  test.addTrack(0, {{1, 2}, {2, 2}, {3, 2}});
  test.addTrack(1, {{4, 5}, {5, 5}});
  test.map.loops = {{{1, 2, 0}, {4, 5, 0}, Verdict::kInlier},
                    {{1, 2, 0}, {5, 5, 0}, Verdict::kOutlier}};
}

TEST(SimpleMap, HasThePosesAndTheScansOfAllKeyNodes) {
  TestMap test;
  fill(test);
  mrpt::maps::CSimpleMap read;
  ASSERT_TRUE(read.loadFromFile(SimpleMap().exportMap(test.map, freshFolder() + "/map").at(0)));
  ASSERT_EQ(read.size(), 3u);
  std::vector<Eigen::Vector3d> expected, found;
  for (size_t i = 0; i < read.size(); ++i) {
    const MapKeyNode& key_node = test.map.key_nodes[i];
    const auto [pdf, frame] = read.get(i);
    const auto pose = pdf->getMeanVal();
    EXPECT_TRUE(pose.getHomogeneousMatrixVal<mrpt::math::CMatrixDouble44>().asEigen().isApprox(
        key_node.world_T_base.matrix(), 1e-9));
    if (key_node.scan)
      for (const auto& point : key_node.scan->points)
        expected.push_back(key_node.world_T_base * point.cast<double>());
    for (const auto& observation : *frame) {
      const auto cloud = std::dynamic_pointer_cast<mrpt::obs::CObservationPointCloud>(observation);
      ASSERT_TRUE(cloud);
      EXPECT_EQ(cloud->sensorLabel.rfind(test.robots.name(key_node.id.robot) + "/", 0), 0u);
      for (size_t k = 0; k < cloud->pointcloud->size(); ++k) {
        mrpt::math::TPoint3D p;
        cloud->pointcloud->getPoint(k, p.x, p.y, p.z);
        p = (pose + cloud->sensorPose).composePoint(p);
        found.emplace_back(p.x, p.y, p.z);
      }
    }
  }
  ASSERT_EQ(found.size(), expected.size());
  for (size_t i = 0; i < found.size(); ++i) EXPECT_TRUE(found[i].isApprox(expected[i], 1e-5));
}

TEST(Scene3d, HasThePointsTheWaysAndTheAcceptedLoops) {
  TestMap test;
  fill(test);
  mrpt::opengl::COpenGLScene scene;
  ASSERT_TRUE(scene.loadFromFile(Scene3d().exportMap(test.map, freshFolder() + "/map").at(0)));
  const auto points =
      std::dynamic_pointer_cast<mrpt::opengl::CPointCloud>(scene.getByName("points"));
  ASSERT_TRUE(points);
  EXPECT_EQ(points->size(), 4u);
  const auto lines = [&](const std::string& name) {
    const auto found = std::dynamic_pointer_cast<mrpt::opengl::CSetOfLines>(scene.getByName(name));
    return found ? found->getLineCount() : 0;
  };
  EXPECT_EQ(lines("way of husky1"), 2u);
  EXPECT_EQ(lines("way of spot2"), 1u);
  EXPECT_EQ(lines("loop closures"), 1u);
}

}  // namespace
}  // namespace lamp
