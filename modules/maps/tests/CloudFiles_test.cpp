#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <pcl/conversions.h>
#include <pcl/io/pcd_io.h>
#include <pcl/io/ply_io.h>

#include "TestRays.h"
#include "lamp/core/Csv.h"
#include "lamp/maps/Pcd.h"
#include "lamp/maps/Ply.h"

namespace lamp {
namespace {

using testing::HasSubstr;

struct ReadPoint {
  float x, y, z, intensity;
  int r, g, b;
};

float floatField(const pcl::PCLPointCloud2& cloud, size_t point, const std::string& name) {
  for (const auto& field : cloud.fields)
    if (field.name == name) {
      float value;
      std::memcpy(&value, &cloud.data[point * cloud.point_step + field.offset], sizeof(value));
      return value;
    }
  return -1;
}

/** Reads with PCL's own readers. */
std::vector<ReadPoint> read(const std::string& path) {
  pcl::PCLPointCloud2 cloud;
  const bool is_ply = path.substr(path.size() - 4) == ".ply";
  const int status =
      is_ply ? pcl::PLYReader().read(path, cloud) : pcl::PCDReader().read(path, cloud);
  EXPECT_EQ(status, 0) << path;
  std::vector<ReadPoint> points;
  for (size_t i = 0; i < cloud.width * cloud.height; ++i) {
    const float packed = floatField(cloud, i, "rgb");
    uint32_t rgb;
    std::memcpy(&rgb, &packed, sizeof(rgb));
    points.push_back({floatField(cloud, i, "x"), floatField(cloud, i, "y"),
                      floatField(cloud, i, "z"), floatField(cloud, i, "intensity"),
                      static_cast<int>(rgb >> 16 & 255), static_cast<int>(rgb >> 8 & 255),
                      static_cast<int>(rgb & 255)});
  }
  return points;
}

/** Also what moves. */
CloudOptions everything(double voxel_m) {
  CloudOptions options;
  options.voxel_m = voxel_m;
  options.moving = true;
  return options;
}

/** The same tests for both formats. */
class CloudFiles : public testing::TestWithParam<const char*> {
 protected:
  std::vector<std::string> exportMap(const ComponentMap& map, double voxel_m,
                                     const std::string& stem) {
    return exportMap(map, everything(voxel_m), stem);
  }
  std::vector<std::string> exportMap(const ComponentMap& map, const CloudOptions& options,
                                     const std::string& stem) {
    if (std::string(GetParam()) == "ply") return Ply(options).exportMap(map, stem);
    return Pcd(options).exportMap(map, stem);
  }
  std::string write(const ComponentMap& map, double voxel_m = 0) {
    const std::string stem = freshFolder() + "/map";
    const auto paths = exportMap(map, voxel_m, stem);
    EXPECT_EQ(paths, std::vector<std::string>{stem + "." + GetParam()});
    return paths.at(0);
  }
  std::string write(const ComponentMap& map, const CloudOptions& options) {
    return exportMap(map, options, freshFolder() + "/map").at(0);
  }
};
INSTANTIATE_TEST_SUITE_P(Formats, CloudFiles, testing::Values("ply", "pcd"),
                         [](const auto& format) { return std::string(format.param); });

TEST_P(CloudFiles, TheOffsetFromTheWorldStandsInTheHeader) {
  TestMap test;
  test.add(0, planarPose(200.25, 345.5, 0), makeScan({{1, 0, 0.5f}, {0.0625f, 2, -1}}));
  const std::string near_origin = write(test.map);
  test.map.world_p_origin = {431000, -5412000, 10000000};
  const std::string far_away = write(test.map);
  EXPECT_THAT(bytesOf(far_away), HasSubstr("offset 431000 -5412000 10000000\n"));
  EXPECT_THAT(bytesOf(near_origin), testing::Not(HasSubstr("offset")));
  const auto points = read(far_away), same = read(near_origin);
  ASSERT_EQ(points.size(), 2u);
  for (size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(points[i].x, same[i].x);
    EXPECT_EQ(points[i].z, same[i].z);
  }
  EXPECT_EQ(points[1].x - points[0].x, -0.9375f);
}

TEST_P(CloudFiles, MovesPointsByThePoseAndColoursThemByRobot) {
  TestMap test;
  test.add(0, planarPose(10, 20, M_PI / 2), makeScan({{1, 0, 0.5f}, {0, 2, -1}}));
  test.add(1, Pose3(Eigen::Translation3d(-3, 0, 1)), makeScan({{0.25f, 0, 0}}));
  const auto points = read(write(test.map));
  ASSERT_EQ(points.size(), 3u);
  EXPECT_NEAR(points[0].x, 10, 1e-5);
  EXPECT_NEAR(points[0].y, 21, 1e-5);
  EXPECT_NEAR(points[0].z, 0.5, 1e-6);
  EXPECT_NEAR(points[1].x, 8, 1e-5);
  EXPECT_NEAR(points[1].y, 20, 1e-5);
  EXPECT_NEAR(points[2].x, -2.75, 1e-6);
  EXPECT_NEAR(points[2].z, 1, 1e-6);
  for (size_t i = 0; i < 3; ++i) {
    const Color expected = robotColor(RobotId{static_cast<uint16_t>(i < 2 ? 0 : 1)});
    EXPECT_EQ(points[i].r, expected.r);
    EXPECT_EQ(points[i].g, expected.g);
    EXPECT_EQ(points[i].b, expected.b);
  }
}

TEST_P(CloudFiles, KeepsIntensityAndMarksWhereThereIsNone) {
  TestMap test;
  const auto bright = makeScan({{1, 0, 0}, {2, 0, 0}});
  bright->intensity = {7.5f, 0.25f};
  test.add(0, Pose3::Identity(), bright);
  test.add(1, Pose3::Identity(), makeScan({{3, 0, 0}}));
  const auto points = read(write(test.map));
  ASSERT_EQ(points.size(), 3u);
  EXPECT_EQ(points[0].intensity, 7.5f);
  EXPECT_EQ(points[1].intensity, 0.25f);
  EXPECT_TRUE(std::isnan(points[2].intensity));
}

TEST_P(CloudFiles, HasNoIntensityFieldWhereNoScanHasOne) {
  TestMap test;
  test.add(0, Pose3::Identity(), makeScan({{1, 0, 0}}));
  const std::string path = write(test.map);
  EXPECT_EQ(bytesOf(path).find("intensity"), std::string::npos);
  EXPECT_EQ(read(path).size(), 1u);
}

TEST_P(CloudFiles, ThinsWithOneGridOverAllScans) {
  TestMap test;
  std::vector<Eigen::Vector3f> row;
  for (int i = 0; i < 1000; ++i) row.push_back({0.01f * i + 0.005f, 0, 0});
  test.add(0, Pose3::Identity(), makeScan(row));
  test.add(1, Pose3::Identity(), makeScan(row));
  EXPECT_EQ(read(write(test.map, 0)).size(), 2000u);
  const auto thinned = read(write(test.map, 0.5));
  ASSERT_EQ(thinned.size(), 20u);
  for (const ReadPoint& point : thinned) EXPECT_EQ(point.r, robotColor(RobotId{0}).r);
}

TEST_P(CloudFiles, KeepsThePointNearestTheMeanOfItsVoxel) {
  TestMap test;
  test.add(0, Pose3::Identity(), makeScan({{0.01f, 0.1f, 0.1f}, {0.12f, 0.1f, 0.1f}}));
  test.add(1, Pose3::Identity(), makeScan({{0.19f, 0.1f, 0.1f}, {0.21f, 0.1f, 0.1f}}));
  const auto points = read(write(test.map, 0.2));
  ASSERT_EQ(points.size(), 2u);
  EXPECT_EQ(points[0].x, 0.12f);
  EXPECT_EQ(points[1].x, 0.21f);
}

/** A wall that is seen from six places; before it at first a box, and a speck of dust. */
struct Yard {
  TestMap test;
  Yard() {
    RayWorld wall;
    wall.addBox({6, -6, -3}, {7, 6, 3});
    RayWorld with_box = wall;
    with_box.addBox({3, -0.3, -0.5}, {3.6, 0.3, 0.5});
    with_box.look({0.1, 0.1, 0.1}, test);
    for (int i = 1; i < 6; ++i) wall.look({0.1, 0.1 + 0.6 * i, 0.1}, test);
    auto dusty = std::make_shared<Scan>(*test.map.key_nodes[0].scan);
    dusty->points.push_back({4.5f, 1, 0});
    dusty->sensor.push_back(0);
    test.map.key_nodes[0].scan = dusty;
  }
};

TEST_P(CloudFiles, WhatMovedAwayAndDustStayOnlyIfAskedFor) {
  const Yard yard;
  CloudOptions options;
  const auto beforeTheWall = [&] {
    size_t before = 0, wall = 0;
    for (const ReadPoint& point : read(write(yard.test.map, options)))
      ++(point.x < 5.5f ? before : wall);
    EXPECT_GT(wall, 1000u);
    return before;
  };
  EXPECT_EQ(beforeTheWall(), 0u);
  options.moving = true;
  EXPECT_GT(beforeTheWall(), 50u);
}

TEST_P(CloudFiles, BeyondTheRangeOfTheOccupancyPointsStay) {
  TestMap test;
  test.add(0, Pose3::Identity(), makeScan({{40, 0, 0}, {40, 1, 0}}));
  EXPECT_EQ(read(write(test.map, CloudOptions())).size(), 2u);
}

TEST_P(CloudFiles, ColoursByHeightTimeAndIntensity) {
  TestMap test;
  std::vector<Eigen::Vector3f> mast;
  for (int i = 0; i < 2000; ++i) mast.push_back({0, 0, 0.01f * i});
  const auto bright = makeScan(mast);
  for (int i = 0; i < 2000; ++i) bright->intensity.push_back(1 - i / 2000.0f);
  test.add(0, Pose3::Identity(), bright);
  test.add(0, Pose3(Eigen::Translation3d(1, 0, 0)), makeScan(mast));
  CloudOptions options = everything(0);
  const auto isLow = [](const ReadPoint& p) { return p.r == 68 && p.g == 1 && p.b == 84; };
  const auto isHigh = [](const ReadPoint& p) { return p.r == 253 && p.g == 231 && p.b == 37; };
  options.color = "height";
  auto points = read(write(test.map, options));
  ASSERT_EQ(points.size(), 4000u);
  EXPECT_TRUE(isLow(points[0]) && isHigh(points[1999]) && isLow(points[2000]));
  options.color = "time";
  points = read(write(test.map, options));
  EXPECT_TRUE(isLow(points[1999]) && isHigh(points[2000]));
  options.color = "intensity";
  points = read(write(test.map, options));
  EXPECT_TRUE(isHigh(points[0]) && isLow(points[1999]));
  EXPECT_EQ(points[2000].r, 128) << "none";
}

TEST_P(CloudFiles, NormalsFaceTheSensor) {
  TestMap test;
  std::vector<Eigen::Vector3f> wall;
  // Across the edge of a piece, at y = 0.
  for (int y = -20; y < 20; ++y)
    for (int z = 0; z < 40; ++z) wall.push_back({3, 0.1f * y + 0.05f, 0.1f * z});
  test.add(0, Pose3::Identity(), makeScan(wall));
  CloudOptions options = everything(0.05);
  options.normals = true;
  const std::string path = write(test.map, options);
  pcl::PCLPointCloud2 cloud;
  const bool is_ply = std::string(GetParam()) == "ply";
  ASSERT_EQ(is_ply ? pcl::PLYReader().read(path, cloud) : pcl::PCDReader().read(path, cloud), 0);
  ASSERT_EQ(cloud.width * cloud.height, wall.size());
  // PCL renames those of PLY to its own.
  for (size_t i = 0; i < wall.size(); ++i) EXPECT_NEAR(floatField(cloud, i, "normal_x"), -1, 1e-4);
}

TEST_P(CloudFiles, TilesAreTheSameCloudInPieces) {
  TestMap test;
  std::vector<Eigen::Vector3f> row;
  for (int i = -500; i < 500; ++i) row.push_back({0.03f * i, 0.02f * i, 0.001f * i});
  test.add(0, Pose3::Identity(), makeScan(row));
  CloudOptions options = everything(0.05);
  options.normals = true;
  const auto byX = [](const ReadPoint& a, const ReadPoint& b) { return a.x < b.x; };
  auto whole = read(write(test.map, options));
  std::sort(whole.begin(), whole.end(), byX);

  options.tile_m = 7;
  const std::string stem = freshFolder() + "/map", folder = stem + "_" + GetParam();
  const auto paths = exportMap(test.map, options, stem);
  const CsvTable index = CsvTable::fromFile(folder + "/index.csv");
  ASSERT_EQ(paths.size(), index.rows.size() + 1);
  ASSERT_GT(index.rows.size(), 4u);
  std::vector<ReadPoint> pieces;
  for (size_t i = 0; i < index.rows.size(); ++i) {
    const auto number = [&](const char* column) {
      return std::stof(index.rows[i][index.column(column)]);
    };
    EXPECT_EQ(paths[i], folder + "/" + index.rows[i][index.column("file")]);
    const auto piece = read(paths[i]);
    EXPECT_EQ(static_cast<float>(piece.size()), number("points"));
    for (const ReadPoint& p : piece) {
      EXPECT_GE(p.x, number("x_min") - 1e-3f);
      EXPECT_LE(p.x, number("x_max") + 1e-3f);
      EXPECT_GE(p.z, number("z_min") - 1e-3f);
      EXPECT_LE(p.z, number("z_max") + 1e-3f);
    }
    pieces.insert(pieces.end(), piece.begin(), piece.end());
  }
  std::sort(pieces.begin(), pieces.end(), byX);
  ASSERT_EQ(pieces.size(), whole.size());
  for (size_t i = 0; i < whole.size(); ++i) EXPECT_EQ(pieces[i].x, whole[i].x);

  // What an earlier, larger map had is gone.
  test.map.key_nodes[0].scan = makeScan({{1, 1, 0}});
  EXPECT_EQ(exportMap(test.map, options, stem).size(), 2u);
  EXPECT_EQ(fileCount(folder), 2u);
}

TEST_P(CloudFiles, StreamsMoreThanOneBuffer) {
  TestMap test;
  std::vector<Eigen::Vector3f> points;
  for (int i = 0; i < 100000; ++i) points.push_back({0.01f * (i % 1000), 0.1f * (i / 1000), 0});
  test.add(0, Pose3::Identity(), makeScan(points));
  const auto back = read(write(test.map));
  ASSERT_EQ(back.size(), points.size());
  for (size_t i = 0; i < points.size(); i += 997) {
    EXPECT_EQ(back[i].x, points[i].x());
    EXPECT_EQ(back[i].y, points[i].y());
  }
}

TEST_P(CloudFiles, WritesTheSameBytesTwice) {
  TestMap test;
  test.add(0, planarPose(1, 2, 3), makeScan({{1, 0, 0.5f}, {0, 2, -1}}));
  const std::string first = bytesOf(write(test.map, 0.05));
  EXPECT_EQ(first, bytesOf(write(test.map, 0.05)));
}

TEST_P(CloudFiles, EmptyMapsGiveValidFilesOfNoPoints) {
  TestMap test;
  const auto header_says = [&](const std::string& path) {
    EXPECT_THAT(bytesOf(path),
                HasSubstr(std::string(GetParam()) == "ply" ? "element vertex 0\n" : "POINTS 0\n"));
  };
  header_says(write(test.map));
  test.add(0, Pose3::Identity(), makeScan({}));
  test.add(0, Pose3::Identity(), nullptr);
  header_says(write(test.map, 0.05));
}

TEST_P(CloudFiles, PassesOverPointsThatAreNotFinite) {
  TestMap test;
  const float nan = std::numeric_limits<float>::quiet_NaN();
  test.add(0, Pose3::Identity(), makeScan({{nan, 0, 0}, {1, 1, 1}}));
  EXPECT_EQ(read(write(test.map)).size(), 1u);
}

TEST_P(CloudFiles, RefusesInvalidMapsAndNamesTheKeyNode) {
  TestMap test;
  Pose3 broken = Pose3::Identity();
  broken.translation().x() = std::nan("");
  test.add(1, broken, makeScan({{1, 0, 0}}));
  const std::string folder = freshFolder();
  EXPECT_THAT(errorOf([&] { exportMap(test.map, 0, folder + "/map"); }), HasSubstr("spot2:0"));

  test.map.key_nodes.clear();
  const auto scan = makeScan({{1, 0, 0}});
  scan->sensor.clear();
  test.add(0, Pose3::Identity(), scan);
  EXPECT_THAT(errorOf([&] { exportMap(test.map, 0, folder + "/map"); }), HasSubstr("husky1:0"));
  EXPECT_EQ(fileCount(folder), 0u);
}

TEST_P(CloudFiles, FailuresNameThePathAndLeaveNoFile) {
  TestMap test;
  const std::string folder = freshFolder();
  EXPECT_THAT(errorOf([&] { exportMap(test.map, 0, folder + "/missing/map"); }),
              HasSubstr(folder + "/missing/map." + GetParam()));

  test.add(0, Pose3::Identity(), makeScan({{1e9f, 0, 0}}));
  EXPECT_THAT(errorOf([&] { exportMap(test.map, 0.05, folder + "/map"); }), HasSubstr("voxel_m"));
  EXPECT_EQ(fileCount(folder), 0u);
}

}  // namespace
}  // namespace lamp
