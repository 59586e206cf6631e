#include "lamp/evaluation/MapEvaluation.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "TestClouds.h"
#include "TestRuns.h"
#include "lamp/core/PlyVertices.h"

namespace lamp::evaluation {
namespace {

using namespace test;
using testing::HasSubstr;
using Points = std::vector<Eigen::Vector3f>;

/** A floor of 4 m x 4 m and what is `height` above it. */
Points floorPoints(float height, float x1 = 4) {
  SurfaceSamples floor;
  addLevel(0, x1, 0, 4, height, 1, floor);
  return floor.points;
}
SurfaceSamples trueFloor() {
  SurfaceSamples floor;
  addLevel(0, 4, 0, 4, 0, 1, floor);
  return floor;
}

MapEvaluation evaluate(const Points& map, SurfaceSamples truth,
                       const Pose3& truth_T_map = Pose3::Identity()) {
  const std::string path = freshFolder() + "/map.ply";
  writePly(path, map);
  return evaluateMap(path, truth_T_map, TrueSurface(std::move(truth)));
}

TEST(MapEvaluation, APlaneMovedBy10CentimetresIs10CentimetresOff) {
  const auto map = evaluate(floorPoints(0.1f), trueFloor());
  EXPECT_EQ(map.name, "map");
  EXPECT_EQ(map.accuracy_m.count, 1600u);
  EXPECT_NEAR(map.accuracy_m.mean, 0.1, 1e-5);
  EXPECT_NEAR(map.accuracy_m.p95, 0.1, 1e-5);
  EXPECT_EQ(map.completeness, 1);
}

TEST(MapEvaluation, AShiftAlongTheSurfaceIsNoError) {
  EXPECT_NEAR(evaluate(floorPoints(0), trueFloor(), pose(0.04, 0.03, 0)).accuracy_m.max, 0, 1e-6);
}

TEST(MapEvaluation, TheAlignmentMovesTheMap) {
  const Pose3 truth_T_map = pose(3, -2, 5, 1, 0.2, 0.1);
  Points map;
  for (const auto& p : floorPoints(0.1f)) map.push_back(truth_T_map.inverse().cast<float>() * p);
  EXPECT_NEAR(evaluate(map, trueFloor(), truth_T_map).accuracy_m.mean, 0.1, 1e-4);
}

/** National grids: single precision has steps of half a metre there. */
TEST(MapEvaluation, FarFromTheOriginOnlyOffsetsDiffer) {
  const std::string path = freshFolder() + "/map.ply";
  std::string map = "ply\nformat ascii 1.0\ncomment offset 431000 5412000 0\nelement vertex ",
              truth = "ply\nformat ascii 1.0\nelement vertex ", map_rows, truth_rows;
  const Points floor = floorPoints(0.03f);
  for (const Eigen::Vector3f& p : floor) {
    const std::string y = std::to_string(p.y() + 345);
    map_rows += std::to_string(p.x() + 200) + " " + y + " " + std::to_string(p.z()) + "\n";
    truth_rows += std::to_string(431200.0 + p.x()) + " 5412" + y + " 0 0 0 1\n";
  }
  for (auto [text, type] : {std::pair{&map, "float"}, {&truth, "double"}}) {
    *text += std::to_string(floor.size()) + "\n";
    for (const char* name : {"x", "y", "z"})
      *text += std::string("property ") + type + " " + name + "\n";
  }
  writeTextFile(path, map + "end_header\n" + map_rows);
  const std::string truth_path = freshFolder() + "/truth.ply";
  writeTextFile(truth_path, truth +
                                "property float nx\nproperty float ny\nproperty float nz\n"
                                "end_header\n" +
                                truth_rows);
  const TrueSurface surface(SurfaceSamples::fromPly(truth_path));
  const Eigen::Vector3d origin = surface.samples().world_p_origin;
  EXPECT_EQ(origin, Eigen::Vector3d(431000, 5412000, 0));
  const auto result = evaluateMap(path, Pose3(Eigen::Translation3d(-origin)), surface);
  EXPECT_NEAR(result.accuracy_m.mean, 0.03, 1e-4);
  EXPECT_NEAR(result.accuracy_m.max, 0.03, 1e-4);
  EXPECT_EQ(result.completeness, 1);
  const std::string errors = freshFolder() + "/errors.ply";
  writeErrorPly(errors, result, 0.1);
  EXPECT_EQ(PlyVertices(errors).offset(), origin);
}

TEST(MapEvaluation, HalfAMapIsHalfComplete) {
  const auto map = evaluate(floorPoints(0, 2), trueFloor());
  EXPECT_NEAR(map.accuracy_m.max, 0, 1e-6);
  // The last row of points reaches 0.2 m further: two rows of 40, the second one at just 0.2 m.
  EXPECT_NEAR(map.completeness, 0.5, 0.051);
  EXPECT_GT(map.completeness, 0.5);
}

TEST(MapEvaluation, OnlySeenSamplesMustBeInTheMap) {
  SurfaceSamples truth = trueFloor();
  for (size_t i = 0; i < truth.points.size(); ++i) truth.seen[i] = truth.points[i].x() < 2;
  EXPECT_EQ(evaluate(floorPoints(0, 2), truth).completeness, 1);
  EXPECT_EQ(evaluate(floorPoints(0.25f), truth).completeness, 0) << "further than 0.2 m";
}

TEST(MapEvaluation, APlaneDoesNotReachBeyondItsSurface) {
  // On the plane of the floor, 3 m beside it: no surface is there.
  EXPECT_NEAR(evaluate({{7, 2.05f, 0}}, trueFloor()).accuracy_m.mean, 3.05, 1e-3);
}

TEST(MapEvaluation, TheErrorPlyReadsBack) {
  const auto map = evaluate({{1.05f, 1.05f, 0.1f}, {1.05f, 1.05f, 0.0f}}, trueFloor());
  const std::string path = freshFolder() + "/error.ply";
  writeErrorPly(path, map, errorScale(map));
  std::vector<std::vector<double>> rows;
  PlyVertices(path).read({"x", "z", "error", "red", "green", "blue"},
                         [&](const double* v) { rows.emplace_back(v, v + 6); });
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_NEAR(rows[0][0], 1.05, 1e-6);
  EXPECT_NEAR(rows[0][2], 0.1, 1e-6);
  EXPECT_NEAR(rows[1][2], 0.0, 1e-6);
  EXPECT_THAT(std::vector<double>(rows[0].begin() + 3, rows[0].end()),
              testing::ElementsAre(253, 231, 37));
  EXPECT_THAT(std::vector<double>(rows[1].begin() + 3, rows[1].end()),
              testing::ElementsAre(68, 1, 84));
}

TEST(MapEvaluation, TheScaleOfColoursIsRound) {
  MapEvaluation map;
  for (const auto& [p95, scale] : {std::pair(0.0, 0.1), std::pair(0.1, 0.1), std::pair(0.13, 0.2),
                                   std::pair(0.4, 0.5), std::pair(0.7, 1.0), std::pair(3.0, 5.0)}) {
    map.accuracy_m.p95 = p95;
    EXPECT_NEAR(errorScale(map), scale, 1e-9) << p95;
  }
}

TEST(SurfaceSamples, SeenIsOptionalAndNormalsAreNot) {
  const std::string path = freshFolder() + "/map.ply";
  const std::string start =
      "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\n"
      "property float y\nproperty float z\n";
  const std::string normals = "property float nx\nproperty float ny\nproperty float nz\n";
  writeTextFile(path, start + normals + "end_header\n1 2 3 0 0 2\n");
  const SurfaceSamples samples = SurfaceSamples::fromPly(path);
  EXPECT_EQ(samples.points.at(0), Eigen::Vector3f(1, 2, 3));
  EXPECT_EQ(samples.normals.at(0), Eigen::Vector3f(0, 0, 1));
  EXPECT_EQ(samples.seen.at(0), 1);
  writeTextFile(path, start + "end_header\n1 2 3\n");
  EXPECT_THAT(thrownBy([&] { SurfaceSamples::fromPly(path); }), HasSubstr("without 'nx'"));
  writeTextFile(path, start + normals + "end_header\n1 2 3 0 0 0\n");
  EXPECT_THAT(thrownBy([&] { SurfaceSamples::fromPly(path); }), HasSubstr("zero normal"));
  writeTextFile(path, start + normals + "property uchar seen\nend_header\n1 2 3 0 0 1 0\n");
  EXPECT_THAT(thrownBy([&] { SurfaceSamples::fromPly(path); }),
              HasSubstr("no sample that was seen"));
}

}  // namespace
}  // namespace lamp::evaluation
