#include "lamp/core/PlyVertices.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <sstream>

#include "TestSupport.h"
#include "lamp/core/Files.h"

namespace lamp {
namespace {

using namespace test;
using testing::HasSubstr;

std::string header(const std::string& format, const std::string& count = "2") {
  return "ply\nformat " + format + " 1.0\ncomment c\nelement vertex " + count +
         "\nproperty uchar seen\nproperty double x\nproperty float y\nproperty short z\n"
         "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
}

std::vector<std::vector<double>> readXyzSeen(const std::string& content) {
  const std::string path = freshFolder() + "/t.ply";
  writeTextFile(path, content);
  std::vector<std::vector<double>> rows;
  PlyVertices(path).read({"x", "y", "z", "seen"},
                         [&](const double* v) { rows.emplace_back(v, v + 4); });
  return rows;
}

template <class T>
std::string bytes(T value) {
  std::string text(sizeof value, '\0');
  std::memcpy(text.data(), &value, sizeof value);
  return text;
}

template <class T>
std::string reversed(T value) {
  std::string text = bytes(value);
  std::reverse(text.begin(), text.end());
  return text;
}

TEST(PlyVertices, TellTheOffsetThatACommentStates) {
  const auto offsetIn = [](const std::string& comment) {
    const std::string path = freshFolder() + "/t.ply";
    writeTextFile(path, "ply\nformat ascii 1.0\n" + comment +
                            "element vertex 1\nproperty double x\nend_header\n1\n");
    return PlyVertices(path).offset();
  };
  EXPECT_EQ(offsetIn("comment offset 431000 -5412000.25 3e2\n"),
            Eigen::Vector3d(431000, -5412000.25, 300));
  for (const char* none : {"", "comment\n", "comment offset\n", "comment offset 1 2\n",
                           "comment offset 1 2 3 4\n", "comment offset of the lidar: 1 2 3\n",
                           "comment offset 1 2 nan\n", "comment\toffsets 1 2 3\n"})
    EXPECT_EQ(offsetIn(none), Eigen::Vector3d(0, 0, 0)) << none;
}

TEST(PlyVertices, AsciiAndBinaryAreTheSame) {
  const auto ascii = readXyzSeen(header("ascii") + "1 1.5 2.5 -3\n0 4 5 6\n3 0 1 1\n");
  const auto binary = readXyzSeen(header("binary_little_endian") + bytes<uint8_t>(1) + bytes(1.5) +
                                  bytes(2.5f) + bytes<int16_t>(-3) + bytes<uint8_t>(0) +
                                  bytes(4.0) + bytes(5.0f) + bytes<int16_t>(6) + "face");
  const auto big = readXyzSeen(header("binary_big_endian") + bytes<uint8_t>(1) + reversed(1.5) +
                               reversed(2.5f) + reversed<int16_t>(-3) + bytes<uint8_t>(0) +
                               reversed(4.0) + reversed(5.0f) + reversed<int16_t>(6) + "face");
  EXPECT_THAT(ascii, testing::ElementsAre(testing::ElementsAre(1.5, 2.5, -3, 1),
                                          testing::ElementsAre(4, 5, 6, 0)));
  EXPECT_EQ(ascii, binary);
  EXPECT_EQ(ascii, big);
}

TEST(PlyVertices, WhatManyProgramsWriteIsRead) {
  const testing::Matcher<std::vector<std::vector<double>>> expected =
      testing::ElementsAre(testing::ElementsAre(1, 2, 3, 1));
  const auto head = [](const std::string& format) {
    return "ply\r\nformat " + format +
           " 1.0\r\nobj_info by a scanner\r\nelement camera 2\r\nproperty float f\r\n"
           "element vertex 1\r\nproperty float X\r\nproperty list uchar short views\r\n"
           "property float Y\r\nproperty float Z\r\nproperty uchar seen\r\nend_header \r\n";
  };
  EXPECT_THAT(readXyzSeen("\xEF\xBB\xBF" + head("ascii") + "0.5\r\n0.6\r\n\r\n1 2 7 8 2\t3 1\r\n"),
              expected);
  std::string binary = head("binary_little_endian");
  binary.replace(binary.size() - 2, 2, "\n");
  EXPECT_THAT(readXyzSeen(binary + bytes(0.5f) + bytes(0.6f) + bytes(1.0f) + bytes<uint8_t>(2) +
                          bytes<int16_t>(7) + bytes<int16_t>(8) + bytes(2.0f) + bytes(3.0f) +
                          bytes<uint8_t>(1)),
              expected);
}

TEST(PlyVertices, AreReadFromAnyStream) {
  PlyVertices vertices(std::make_unique<std::istringstream>(header("ascii", "1") + "1 2 3 4\n"),
                       "memory");
  double z = 0;
  for (int again = 0; again < 2; ++again) {
    vertices.read({"z"}, [&](const double* v) { z += *v; });
  }
  EXPECT_EQ(z, 8);
}

TEST(PlyVertices, DamagedFilesAreErrors) {
  const std::string good = header("binary_little_endian");
  const auto error = [](const std::string& content) {
    return thrownBy([&] { readXyzSeen(content); });
  };
  EXPECT_THAT(error(""), HasSubstr("is not a PLY file"));
  EXPECT_THAT(error("plz"), HasSubstr("is not a PLY file"));
  EXPECT_THAT(error(good.substr(0, good.size() - 11)), HasSubstr("ends within its header"));
  EXPECT_THAT(error(good + std::string(28, '\0')), HasSubstr("too short for the 2 vertices"));
  EXPECT_THAT(error(header("ascii", "1e12") + "1 2 3 4\n"), HasSubstr("too short for the 1000"));
  EXPECT_THAT(error(header("ascii") + "1 2 3.000000000 4\n"), HasSubstr("at vertex 2 of 2"));
  EXPECT_THAT(error(header("ascii") + "1 2 3 4\n1 x 3 4\n"), HasSubstr("t.ply:13: 'x' is no"));
  EXPECT_THAT(error(header("ascii") + "1 2 3 4\n1 2,5 3 4\n"), HasSubstr("need a decimal point"));
  EXPECT_THAT(error(header("ascii") + "1 2 3\n1 2 3 4.0000000\n"),
              HasSubstr("t.ply:12: has only 3"));
  EXPECT_THAT(error(header("ascii") + "1 2 3 4 5\n1 2 3 4\n"), HasSubstr("5 values instead of 4"));
  EXPECT_THAT(error(header("ascii") + "1 2 3 4\n1 nan 3 4\n"), HasSubstr("not finite in vertex 2"));
  EXPECT_THAT(error(header("binary_middle_endian")), HasSubstr("t.ply:2: the format"));
  EXPECT_THAT(error(header("ascii", "many")), HasSubstr("t.ply:4: 'many' is not a number"));
  EXPECT_THAT(error(header("ascii", "-1")), HasSubstr("t.ply:4: '-1' is not a number of elements"));
  EXPECT_THAT(error("ply\nformat ascii 1.0\nend_header\n"), HasSubstr("has no vertices"));
  EXPECT_THAT(error("ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nend_header\n1\n"),
              HasSubstr("without 'y'"));
  EXPECT_THAT(error("ply\nformat ascii 1.0\nelement vertex 1\nproperty half x\n"),
              HasSubstr("t.ply:4: there is no type 'half'"));
  EXPECT_THAT(error("ply\nformat ascii 1.0\nproperty float x\n"), HasSubstr("before all elements"));
  EXPECT_THAT(error("ply\nelement vertex 1\nproperty float x\nend_header\n1\n"),
              HasSubstr("no 'format'"));
  EXPECT_THAT(thrownBy([] { PlyVertices("/nowhere.ply"); }), HasSubstr("'/nowhere.ply'"));
}

TEST(PlyVertices, ValuesThatAreNotFiniteAreTakenWhereTheyAreAskedFor) {
  const std::string path = freshFolder() + "/t.ply";
  writeTextFile(path, header("ascii", "1") + "1 nan 2 3\n");
  std::vector<double> x;
  const auto take = [&](const double* v) { x.push_back(*v); };
  EXPECT_THAT(thrownBy([&] { PlyVertices(path).read({"x"}, take); }), HasSubstr("not finite"));
  PlyVertices(path).read({"x"}, take, PlyVertices::NotFinite::kTake);
  ASSERT_EQ(x.size(), 1u);
  EXPECT_TRUE(std::isnan(x[0]));
}

}  // namespace
}  // namespace lamp
