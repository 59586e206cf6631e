#include "lamp/maps/Picture.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <mrpt/img/CImage.h>

#include "Legend.h"
#include "TestMaps.h"
#include "TestPixels.h"
#include "TopView.h"

namespace lamp {
namespace {

using mrpt::img::CImage;
using testing::HasSubstr;

constexpr int kMargin_px = 20;

bool alike(Color a, Color b, int tolerance = 40) {
  return std::abs(a.r - b.r) <= tolerance && std::abs(a.g - b.g) <= tolerance &&
         std::abs(a.b - b.b) <= tolerance;
}

size_t count(const CImage& image, Color color, int rows) {
  size_t n = 0;
  for (int y = 0; y < rows; ++y)
    for (int x = 0; x < static_cast<int>(image.getWidth()); ++x)
      n += inked(pixelAt(image, x, y), color);
  return n;
}

/** A map, its picture, and the way from the world to the picture's pixels. */
struct Drawn {
  TopView view;
  CImage image;

  explicit Drawn(const ComponentMap& map, const PictureOptions& options = {}) {
    const auto paths = Picture(options).exportMap(map, freshFolder() + "/map");
    EXPECT_TRUE(image.loadFromFile(paths.at(0)));
    EXPECT_EQ(paths.at(0).substr(paths.at(0).size() - 8), "/map.png");
    view = viewOf(map, options.size_px, options.finest_pixel_m);
  }
  int left() const { return (static_cast<int>(image.getWidth()) - view.width) / 2; }
  Color at(double x, double y) const {
    const Eigen::Vector2d p = view.toPixel({x, y, 0});
    return pixelAt(image, left() + static_cast<int>(p.x()), kMargin_px + static_cast<int>(p.y()));
  }
  size_t countInMap(Color color) const { return count(image, color, kMargin_px + view.height); }
};

/** A wall along x as points 1 cm apart. */
KeyedScanPtr wallAlongX(double y, double length) {
  std::vector<Eigen::Vector3f> points;
  for (double x = 0; x < length; x += 0.01)
    for (double z = 0; z < 1; z += 0.25) points.push_back(Eigen::Vector3d(x, y, z).cast<float>());
  return makeScan(points);
}

TEST(Picture, TellsADoubleWallFromASingleOne) {
  TestMap test;
  test.add(0, Pose3::Identity(), wallAlongX(0.0, 20));
  test.add(0, Pose3::Identity(), wallAlongX(0.2, 20));
  test.add(0, Pose3::Identity(), wallAlongX(10.0, 20));
  const Drawn drawn(test.map);
  // Dark runs down the picture at x = 10 m, from top to bottom.
  std::vector<double> runs;
  bool was_dark = false;
  const int x = drawn.left() + static_cast<int>(drawn.view.toPixel({10, 0, 0}).x());
  for (int y = kMargin_px; y < kMargin_px + drawn.view.height; ++y) {
    const bool dark = pixelAt(drawn.image, x, y).r < 128;
    if (dark && !was_dark) runs.push_back(y);
    was_dark = dark;
  }
  ASSERT_EQ(runs.size(), 3u);
  EXPECT_NEAR((runs[1] - runs[0]) / (runs[2] - runs[0]), 9.8 / 10.0, 0.003);
}

TEST(Picture, IsDarkerWhereThereAreMorePoints) {
  TestMap test;
  test.add(0, Pose3::Identity(), wallAlongX(0.0, 20));
  std::vector<Eigen::Vector3f> floor;
  for (float x = 0; x < 20; x += 0.05f)
    for (float y = 1; y < 10; y += 0.05f) floor.push_back({x, y, 0});
  test.add(0, Pose3::Identity(), makeScan(floor));
  PictureOptions options;
  options.size_px = 300;
  const Drawn drawn(test.map, options);
  EXPECT_LT(drawn.at(10, 0).r + 60, drawn.at(10, 5).r);
  EXPECT_LT(drawn.at(10, 5).r, 250);
}

TEST(Picture, DrawsTracksInTheColoursOfTheRobotsAndNorthUp) {
  TestMap test;
  test.add(0, Pose3::Identity(), wallAlongX(0.0, 20));
  test.addTrack(0, {{2, 5}, {15, 5}});
  test.addTrack(1, {{2, 8}, {15, 8}});
  const Drawn drawn(test.map);
  EXPECT_TRUE(alike(drawn.at(9, 5), robotColor(RobotId{0}), 10));
  EXPECT_TRUE(alike(drawn.at(9, 8), robotColor(RobotId{1}), 10));
  EXPECT_TRUE(alike(drawn.at(9, 6.5), {255, 255, 255}, 0));
  EXPECT_LT(drawn.view.toPixel({0, 8, 0}).y(), drawn.view.toPixel({0, 5, 0}).y());
  EXPECT_LT(drawn.view.toPixel({2, 0, 0}).x(), drawn.view.toPixel({15, 0, 0}).x());
}

TEST(Picture, DrawsLoopsByVerdict) {
  TestMap test;
  test.addTrack(0, {{0, 0}, {20, 0}});
  test.map.loops = {{{5, 1, 0}, {5, 9, 0}, Verdict::kInlier},
                    {{10, 1, 0}, {10, 9, 0}, Verdict::kOutlier},
                    {{15, 1, 0}, {15, 9, 0}, Verdict::kPending}};
  const Drawn drawn(test.map);
  const auto near = [&](double x, Color color) {
    for (int dx = -1; dx <= 1; ++dx)
      if (inked(drawn.at(x + dx * drawn.view.pixel_m, 5), color)) return true;
    return false;
  };
  EXPECT_TRUE(near(5, kAcceptedColor));
  EXPECT_TRUE(near(10, kRejectedColor));
  EXPECT_TRUE(near(15, kPendingColor));

  PictureOptions without;
  without.rejected_loops = false;
  EXPECT_GT(drawn.countInMap(kRejectedColor), 0u);
  EXPECT_EQ(Drawn(test.map, without).countInMap(kRejectedColor), 0u);
}

TEST(Picture, KeepsToTheSizeAndToTheFinestPixel) {
  TestMap test;
  test.addTrack(0, {{0, 0}, {100, 30}});
  PictureOptions options;
  options.size_px = 1000;
  const Drawn large(test.map, options);
  EXPECT_EQ(large.view.width, 1000);
  EXPECT_NEAR(large.view.height, 1000.0 * 34 / 104, 2);

  TestMap small_test;
  small_test.addTrack(0, {{0, 0}, {3, 1}});
  const Drawn small(small_test.map, options);
  EXPECT_EQ(small.view.width, 200);  // 3 m and two margins of 0.5 m, at 2 cm
  EXPECT_GE(small.image.getWidth(), 200u);
}

TEST(Picture, FramesWithoutTheOutermostPoints) {
  TestMap test;
  std::vector<Eigen::Vector3f> points{{500, 0, 0}};
  for (int i = 0; i < 5000; ++i) points.push_back({0.01f * (i % 1000), 0.5f * (i / 1000), 0});
  test.add(0, Pose3::Identity(), makeScan(points));
  const Drawn drawn(test.map);
  EXPECT_LT(drawn.view.width * drawn.view.pixel_m, 12);
}

TEST(Picture, EmptyMapsGiveAPicture) {
  TestMap test;
  EXPECT_GT(Drawn(test.map).image.getWidth(), 100u);

  test.add(0, Pose3::Identity(), makeScan({}));
  test.add(0, planarPose(4, 0, 0), nullptr);
  test.addTrack(0, {{0, 0}, {4, 0}});
  test.addTrack(1, {});
  test.addTrack(1, {{1, 1}});
  const Drawn drawn(test.map);
  EXPECT_TRUE(alike(drawn.at(2, 0), robotColor(RobotId{0}), 10));
}

TEST(Picture, WritesTheSameBytesTwice) {
  TestMap test;
  test.add(0, Pose3::Identity(), wallAlongX(0.0, 3));
  test.addTrack(0, {{0, 1}, {1, 1.5}, {3, 1}});
  const auto bytes = [&] {
    return bytesOf(Picture().exportMap(test.map, freshFolder() + "/map").at(0));
  };
  EXPECT_EQ(bytes(), bytes());
}

TEST(Picture, RefusesInvalidMapsAndMissingFolders) {
  TestMap test;
  const std::string folder = freshFolder();
  EXPECT_THAT(errorOf([&] { Picture().exportMap(test.map, folder + "/missing/map"); }),
              HasSubstr(folder + "/missing/map.png"));
  test.addTrack(1, {{std::nan(""), 0}});
  EXPECT_THAT(errorOf([&] { Picture().exportMap(test.map, folder + "/map"); }), HasSubstr("spot2"));
  test.map.tracks.clear();
  test.map.loops = {{{0, 0, 0}, {INFINITY, 0, 0}, Verdict::kInlier}};
  EXPECT_THAT(errorOf([&] { Picture().exportMap(test.map, folder + "/map"); }), HasSubstr("loop"));
  EXPECT_EQ(fileCount(folder), 0u);
}

TEST(Legend, CountsKeyNodesAndLoops) {
  TestMap test;
  test.add(0, Pose3::Identity(), nullptr);
  test.add(1, Pose3::Identity(), nullptr);
  test.add(1, Pose3::Identity(), nullptr);
  test.map.loops = {{{0, 0, 0}, {1, 0, 0}, Verdict::kInlier},
                    {{0, 0, 0}, {1, 0, 0}, Verdict::kOutlier},
                    {{0, 0, 0}, {1, 0, 0}, Verdict::kOutlier}};
  std::vector<std::string> texts;
  for (const LegendEntry& entry : legendOf(test.map)) texts.push_back(entry.text);
  EXPECT_THAT(texts, testing::ElementsAre("husky1: 1 key node", "spot2: 2 key nodes",
                                          "1 loop accepted", "2 rejected"));
}

TEST(Legend, ScaleBarsAreRound) {
  EXPECT_DOUBLE_EQ(roundLength(0.7), 0.5);
  EXPECT_DOUBLE_EQ(roundLength(1.0), 1.0);
  EXPECT_DOUBLE_EQ(roundLength(37), 20);
  EXPECT_DOUBLE_EQ(roundLength(999), 500);
}

}  // namespace
}  // namespace lamp
