#include "lamp/core/CloudFile.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <pcl/io/pcd_io.h>
#include <pcl/io/ply_io.h>
#include <pcl/point_types.h>

#include <cmath>
#include <limits>
#include <sstream>

#include "TestSupport.h"
#include "lamp/core/Csv.h"
#include "lamp/core/Files.h"

namespace lamp {
namespace {

using namespace test;
using testing::AllOf;
using testing::HasSubstr;

/** x, y and z stand among other fields of other types, with padding between them. */
pcl::PointCloud<pcl::PointXYZRGBNormal> someCloud(size_t points) {
  Random random;
  pcl::PointCloud<pcl::PointXYZRGBNormal> cloud;
  for (size_t i = 0; i < points; ++i) {
    pcl::PointXYZRGBNormal point;
    for (float* value : {&point.x, &point.y, &point.z, &point.normal_x, &point.curvature})
      *value = static_cast<float>(random.uniform(-50, 50));
    cloud.push_back(point);
  }
  return cloud;
}

struct Format {
  const char* name;
  const char* file;
  int (*write)(const std::string& path, const pcl::PointCloud<pcl::PointXYZRGBNormal>& cloud);
};

template <class Cloud>
int writePcdAscii(const std::string& path, const Cloud& cloud) {
  return pcl::PCDWriter().writeASCII(path, cloud, 9);
}
template <class Cloud>
int writePcdBinary(const std::string& path, const Cloud& cloud) {
  return pcl::PCDWriter().writeBinary(path, cloud);
}
template <class Cloud>
int writePcdCompressed(const std::string& path, const Cloud& cloud) {
  return pcl::PCDWriter().writeBinaryCompressed(path, cloud);
}
template <class Cloud>
int writePlyAscii(const std::string& path, const Cloud& cloud) {
  pcl::PCLPointCloud2 blob;
  pcl::toPCLPointCloud2(cloud, blob);
  return pcl::PLYWriter().writeASCII(path, blob, {0, 0, 0, 0}, Eigen::Quaternionf::Identity(), 9,
                                     true);
}
template <class Cloud>
int writePlyBinary(const std::string& path, const Cloud& cloud) {
  pcl::PCLPointCloud2 blob;
  pcl::toPCLPointCloud2(cloud, blob);
  return pcl::PLYWriter().writeBinary(path, blob, {0, 0, 0, 0}, Eigen::Quaternionf::Identity(),
                                      false);
}

/** PCL writes texts of PLY with 6 digits. */
float distanceTo(const pcl::PointXYZRGBNormal& written, const Eigen::Vector3f& read) {
  return (written.getVector3fMap() - read).norm();
}

/** Files that PCL wrote. */
class CloudOfPcl : public testing::TestWithParam<Format> {
 protected:
  CloudPoints readBack(const pcl::PointCloud<pcl::PointXYZRGBNormal>& cloud) {
    const std::string path = freshFolder() + "/" + GetParam().file;
    EXPECT_EQ(GetParam().write(path, cloud), 0);
    return readCloudPoints(path);
  }
};
INSTANTIATE_TEST_SUITE_P(Formats, CloudOfPcl,
                         testing::Values(Format{"pcd_ascii", "a.pcd", writePcdAscii},
                                         Format{"pcd_binary", "b.PCD", writePcdBinary},
                                         Format{"pcd_compressed", "c.pcd", writePcdCompressed},
                                         Format{"ply_ascii", "a.ply", writePlyAscii},
                                         Format{"ply_binary", "b.ply", writePlyBinary}),
                         [](const auto& format) { return std::string(format.param.name); });

TEST_P(CloudOfPcl, ReadsBack) {
  const auto cloud = someCloud(2000);
  const CloudPoints read = readBack(cloud);
  EXPECT_EQ(read.not_finite, 0u);
  EXPECT_EQ(read.viewpoint.value(), Eigen::Vector3d::Zero());
  EXPECT_EQ(read.offset, Eigen::Vector3d::Zero());
  ASSERT_EQ(read.points.size(), cloud.size());
  for (size_t i = 0; i < cloud.size(); ++i)
    EXPECT_NEAR(distanceTo(cloud[i], read.points[i]), 0, 1e-4) << i;
}

TEST_P(CloudOfPcl, PointsThatAreNowhereAreLeftOutAndCounted) {
  auto cloud = someCloud(5);
  cloud[1].y = std::numeric_limits<float>::quiet_NaN();
  cloud[4].z = std::numeric_limits<float>::infinity();
  const CloudPoints read = readBack(cloud);
  EXPECT_EQ(read.not_finite, 2u);
  ASSERT_EQ(read.points.size(), 3u);
  EXPECT_NEAR(distanceTo(cloud[2], read.points[1]), 0, 1e-4);
}

TEST_P(CloudOfPcl, NoUsablePointIsAnError) {
  auto cloud = someCloud(1);
  cloud[0].x = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THAT(thrownBy([&] { readBack(cloud); }),
              AllOf(HasSubstr(GetParam().file), HasSubstr("no point with finite coordinates")));
}

TEST_P(CloudOfPcl, ACutFileIsAnErrorWhereverItIsCut) {
  const std::string path = freshFolder() + "/" + GetParam().file;
  GetParam().write(path, someCloud(20));
  const std::string whole = readTextFile(path);
  // What follows the points is not read, and the last number may be shorter without notice.
  for (size_t length = 0; length + 120 < whole.size(); length += 13) {
    writeTextFile(path, whole.substr(0, length));
    EXPECT_THAT(thrownBy([&] { readCloudPoints(path); }), HasSubstr(GetParam().file)) << length;
  }
}

TEST_P(CloudOfPcl, DamageNeverTakesMoreThanAnError) {
  const std::string path = freshFolder() + "/" + GetParam().file;
  GetParam().write(path, someCloud(20));
  const std::string whole = readTextFile(path);
  Random random;
  for (int trial = 0; trial < 200; ++trial) {
    std::string damaged = whole;
    for (int k = 0; k < 3; ++k)
      damaged[static_cast<size_t>(random.uniform(0, 1) * static_cast<double>(whole.size()))] =
          static_cast<char>(random.uniform(-128, 127));
    writeTextFile(path, damaged);
    try {
      EXPECT_LE(readCloudPoints(path).points.size(), whole.size());
    } catch (const std::runtime_error& error) {
      EXPECT_THAT(error.what(), HasSubstr(GetParam().file));
    }
  }
}

std::string pcdWith(const std::string& line, const std::string& instead,
                    const std::string& points = "1 0 0 0 2 3\n4 0 0 0 5 6\n") {
  std::string text =
      "# .PCD v0.7\nVERSION 0.7\nFIELDS x pad y z\nSIZE 4 2 8 4\nTYPE F U F F\nCOUNT 1 3 1 1\n"
      "WIDTH 2\nHEIGHT 1\nVIEWPOINT 0.5 -1 2 1 0 0 0\nPOINTS 2\nDATA ascii\n";
  text.replace(text.find(line), line.size(), instead);
  return text + points;
}

CloudPoints readPcd(const std::string& content) {
  const std::string path = freshFolder() + "/t.pcd";
  writeTextFile(path, content);
  return readCloudPoints(path);
}

std::string errorOf(const std::string& content) {
  return thrownBy([&] { readPcd(content); });
}

TEST(CloudFile, FieldsOfSeveralNumbersAndTheViewpoint) {
  const CloudPoints cloud = readPcd(pcdWith("", ""));
  EXPECT_EQ(cloud.viewpoint.value(), Eigen::Vector3d(0.5, -1, 2));
  EXPECT_THAT(cloud.points,
              testing::ElementsAre(Eigen::Vector3f(1, 2, 3), Eigen::Vector3f(4, 5, 6)));
}

TEST(CloudFile, LinesOfAHeaderMayBeLeftOutWhereTheyHaveADefault) {
  EXPECT_EQ(readPcd(pcdWith("VIEWPOINT 0.5 -1 2 1 0 0 0\n", "")).viewpoint.value(),
            Eigen::Vector3d::Zero());
  EXPECT_EQ(readPcd(pcdWith("POINTS 2\n", "")).points.size(), 2u);
  EXPECT_EQ(readPcd(pcdWith("COUNT 1 3 1 1\n", "", "1 0 2 3\n4 0 5 6\n")).points.size(), 2u);
  EXPECT_EQ(readPcd(pcdWith("VERSION 0.7", "VERSION .7")).points.size(), 2u);
  EXPECT_EQ(readPcd(pcdWith("VERSION 0.7", "VERSION 0.5")).points.size(), 2u);
  EXPECT_EQ(readPcd(pcdWith("VERSION 0.7\n", "")).points.size(), 2u);
  EXPECT_EQ(readPcd(pcdWith("WIDTH 2\nHEIGHT 1\n", "")).points.size(), 2u);
  EXPECT_EQ(readPcd(pcdWith("x pad y z", "X pad Y Z")).points.size(), 2u);
}

TEST(CloudFile, WrongPcdHeadersNameTheLine) {
  EXPECT_THAT(errorOf(pcdWith("VERSION 0.7", "VERSION 1.0")), HasSubstr("t.pcd:2: VERSION"));
  EXPECT_THAT(errorOf(pcdWith("x pad y z", "x pad y i")), HasSubstr("t.pcd:3: FIELDS"));
  EXPECT_THAT(errorOf(pcdWith("4 2 8 4", "4 2 8")), HasSubstr("t.pcd:4: SIZE"));
  EXPECT_THAT(errorOf(pcdWith("4 2 8 4", "4 2 8 2")), HasSubstr("t.pcd:5: TYPE"));
  EXPECT_THAT(errorOf(pcdWith("1 3 1 1", "1 3 1 2")), HasSubstr("t.pcd:6: COUNT: 'z'"));
  EXPECT_THAT(errorOf(pcdWith("1 3 1 1", "1 -3 1 1")), HasSubstr("t.pcd:6: COUNT: '-3'"));
  EXPECT_THAT(errorOf(pcdWith("WIDTH 2", "WIDTH two")), HasSubstr("t.pcd:7: WIDTH: 'two'"));
  EXPECT_THAT(errorOf(pcdWith("WIDTH 2", "WIDTH 1.5")), HasSubstr("t.pcd:7: WIDTH"));
  EXPECT_THAT(errorOf(pcdWith("HEIGHT 1", "DEPTH 1")), HasSubstr("t.pcd:8: is not a line"));
  EXPECT_THAT(errorOf(pcdWith("HEIGHT 1", "WIDTH 1")), HasSubstr("t.pcd:8: WIDTH appears twice"));
  EXPECT_THAT(errorOf(pcdWith("0.5 -1 2 1", "0.5 nan 2 1")), HasSubstr("t.pcd:9: VIEWPOINT"));
  EXPECT_THAT(errorOf(pcdWith("0.5 -1 2 1 ", "")), HasSubstr("t.pcd:9: VIEWPOINT"));
  EXPECT_THAT(errorOf(pcdWith("POINTS 2", "POINTS 3")), HasSubstr("t.pcd:10: POINTS"));
  EXPECT_THAT(errorOf(pcdWith("ascii", "octal")), HasSubstr("t.pcd:11: DATA: 'octal'"));
  EXPECT_THAT(errorOf("VERSION 0.7\n"), HasSubstr("t.pcd:1: the file ends within its header"));
  EXPECT_THAT(errorOf(""), HasSubstr("ends within its header"));
}

TEST(CloudFile, WrongPcdPointsNameTheLine) {
  EXPECT_THAT(errorOf(pcdWith("", "", "1 0 0 0 2 3\n4 0 0 0 5\n# more\n")), HasSubstr("t.pcd:13:"));
  EXPECT_THAT(errorOf(pcdWith("", "", "1 0 0 0 x 3\n4 0 0 0 5 6\n")), HasSubstr("t.pcd:12:"));
  EXPECT_THAT(errorOf(pcdWith("", "", "1 0 0 0 2 3 7\n4 0 0 0 5 6\n")), HasSubstr("t.pcd:12:"));
  EXPECT_THAT(errorOf(pcdWith("", "", "1 0 0 0 2 3.00000000000000000\n")),
              HasSubstr("ends after 1 of 2 points"));
}

TEST(CloudFile, DecimalCommasAreErrorsWithACure) {
  EXPECT_THAT(errorOf(pcdWith("", "", "1,5 0 0 0 2 3\n4 0 0 0 5 6\n")),
              AllOf(HasSubstr("t.pcd:12: '1,5'"), HasSubstr("decimal point")));
}

/** Points around a place, as text or doubles keep them. */
std::string pcdAround(const Eigen::Vector3d& place, bool as_float) {
  std::string text = "FIELDS x y z\nSIZE 8 8 8\nTYPE F F F\nWIDTH 50\nHEIGHT 1\nDATA ascii\n";
  Random random;
  for (int i = 0; i < 50; ++i) {
    for (int axis = 0; axis < 3; ++axis) {
      const double value = place[axis] + random.uniform(-10, 10);
      text += formatDouble(as_float ? static_cast<double>(static_cast<float>(value)) : value) + " ";
    }
    text += "\n";
  }
  return text;
}

TEST(CloudFile, SurveyCoordinatesKeepTheirMillimetres) {
  const Eigen::Vector3d utm(431200.25, 5412345.5, 312);
  const CloudPoints near = readPcd(pcdAround(Eigen::Vector3d::Zero(), false));
  const CloudPoints far = readPcd(pcdAround(utm, false));
  EXPECT_EQ(far.offset, Eigen::Vector3d(431200, 5412300, 300));
  EXPECT_EQ(far.rounded_to_m, 0);
  EXPECT_FALSE(far.viewpoint.has_value()) << "the origin is 5000 km away";
  ASSERT_EQ(far.points.size(), near.points.size());
  for (size_t i = 0; i < far.points.size(); ++i) {
    const Eigen::Vector3d place = far.points[i].cast<double>() + far.offset;
    EXPECT_LT((place - utm - near.points[i].cast<double>()).norm(), 1e-4) << i;
  }
}

TEST(CloudFile, AStatedOffsetIsAddedToWhatWasTaken) {
  const Eigen::Vector3d stated(431000, 5412000, 0);
  const CloudPoints near = readPcd("# offset 431000 5412000 0\n" + pcdAround({1, 2, 3}, false));
  EXPECT_EQ(near.offset, stated);
  EXPECT_EQ(near.viewpoint.value(), Eigen::Vector3d::Zero());
  const CloudPoints far = readPcd("# offset 431000 5412000 0\n" + pcdAround({50010, 0, 0}, false));
  EXPECT_EQ(far.offset, stated + Eigen::Vector3d(50000, 0, 0));
  EXPECT_EQ(readPcd("# offset of the map\n" + pcdAround({1, 2, 3}, false)).offset,
            Eigen::Vector3d::Zero());
}

TEST(CloudFile, CoordinatesThatFloatsHaveRoundedAreKnown) {
  const Eigen::Vector3d utm(431200.25, 5412345.5, 312), grid(43120.25, 1234.5, 312);
  EXPECT_EQ(readPcd(pcdAround(utm, true)).rounded_to_m, 0.5);
  EXPECT_EQ(readPcd(pcdAround(grid, true)).rounded_to_m, 1.0 / 256);
  EXPECT_EQ(readPcd(pcdAround(Eigen::Vector3d::Zero(), true)).rounded_to_m, 0);
}

TEST(CloudFile, AViewpointInSurveyCoordinatesMovesWithThePoints) {
  std::string text = pcdAround({431200.25, 5412345.5, 312}, false);
  text.insert(text.find("DATA"), "VIEWPOINT 431201 5412346 313 1 0 0 0\n");
  EXPECT_EQ(readPcd(text).viewpoint.value(), Eigen::Vector3d(1, 46, 13));
}

TEST(CloudFile, RaysWithoutReturnAreNoPoints) {
  const CloudPoints cloud = readPcd(pcdWith("", "", "0 0 0 0 0 0\n4 0 0 0 5 6\n"));
  EXPECT_EQ(cloud.points.size(), 1u);
  EXPECT_EQ(cloud.no_return, 1u);
}

TEST(CloudFile, IsReadFromAnyStream) {
  const auto from = [](const std::string& text, CloudKind kind) {
    return readCloudPoints(std::make_unique<std::istringstream>(text), kind, "memory");
  };
  EXPECT_EQ(from(pcdWith("", ""), CloudKind::kPcd).points.size(), 2u);
  EXPECT_THAT(thrownBy([&] { from(pcdWith("", ""), CloudKind::kPly); }),
              HasSubstr("memory:1: is not a PLY file"));
}

TEST(CloudFile, CountsThatTheFileHasNoRoomForAreErrors) {
  std::string absurd = pcdWith("POINTS 2\n", "");
  absurd.replace(absurd.find("WIDTH 2"), 7, "WIDTH 1000000000");
  absurd.replace(absurd.find("HEIGHT 1"), 8, "HEIGHT 1000000000");
  for (const char* data : {"ascii", "binary", "binary_compressed"}) {
    std::string text = absurd;
    text.replace(text.find("ascii"), 5, data);
    EXPECT_THAT(errorOf(text), HasSubstr("is too short for the 1000000000000000000 points"));
  }
}

TEST(CloudFile, NoPointsAndUnknownFilesAreErrors) {
  std::string none = pcdWith("POINTS 2\n", "", "");
  none.replace(none.find("WIDTH 2"), 7, "WIDTH 0");
  EXPECT_THAT(errorOf(none), HasSubstr("holds no point"));
  EXPECT_THAT(thrownBy([] { readCloudPoints("/nowhere.pcd"); }),
              AllOf(HasSubstr("'/nowhere.pcd'"), HasSubstr("there is no such file")));
  EXPECT_THAT(thrownBy([] { readCloudPoints("/nowhere.ply"); }), HasSubstr("'/nowhere.ply'"));
  EXPECT_THAT(thrownBy([] { readCloudPoints("cloud.xyz"); }),
              AllOf(HasSubstr("'cloud.xyz'"), HasSubstr(".ply or .pcd")));
}

}  // namespace
}  // namespace lamp
