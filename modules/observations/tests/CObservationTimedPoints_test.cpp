#include "lamp/observations/CObservationTimedPoints.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <mrpt/io/CFileGZOutputStream.h>
#include <mrpt/io/CMemoryStream.h>
#include <mrpt/opengl/CSetOfObjects.h>
#include <mrpt/serialization/CArchive.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "TemporaryFolder.h"

namespace lamp {
namespace {

using namespace test;
using testing::HasSubstr;

const std::string kRawlogEdit = "/usr/bin/rawlog-edit";

CObservationTimedPoints sweep(size_t points) {
  CObservationTimedPoints o;
  o.sensorLabel = "spot/ouster";
  o.timestamp = mrpt::Clock::fromDouble(1600000000.25);
  o.sensorPose = mrpt::poses::CPose3D(0.1, 0.2, 0.3, 0.4, 0.5, 0.6);
  for (size_t i = 0; i < points; ++i) {
    const auto f = static_cast<float>(i);
    o.x.push_back(f);
    o.y.push_back(2 * f);
    o.z.push_back(-f);
    o.intensity.push_back(0.5f);
    o.time.push_back(-0.05f + 1e-6f * f);
  }
  return o;
}

std::string bytesOf(const CObservationTimedPoints& o) {
  mrpt::io::CMemoryStream memory;
  mrpt::serialization::archiveFrom(memory) << o;
  const auto* data = static_cast<const char*>(memory.getRawBufferData());
  return {data, data + memory.getTotalBytesCount()};
}

mrpt::serialization::CSerializable::Ptr readFrom(const std::string& bytes) {
  mrpt::io::CMemoryStream memory;
  memory.assignMemoryNotOwn(bytes.data(), bytes.size());
  return mrpt::serialization::archiveFrom(memory).ReadObject();
}

TEST(CObservationTimedPoints, IsReadAsItWasWritten) {
  for (const size_t points : {size_t{0}, size_t{3}, size_t{200000}}) {
    const auto written = sweep(points);
    const auto read =
        std::dynamic_pointer_cast<CObservationTimedPoints>(readFrom(bytesOf(written)));
    ASSERT_TRUE(read);
    EXPECT_EQ(read->sensorLabel, written.sensorLabel);
    EXPECT_EQ(read->timestamp, written.timestamp);
    EXPECT_LT(read->sensorPose.distanceEuclidean6D(written.sensorPose), 1e-12);
    EXPECT_EQ(read->x, written.x);
    EXPECT_EQ(read->y, written.y);
    EXPECT_EQ(read->z, written.z);
    EXPECT_EQ(read->intensity, written.intensity);
    EXPECT_EQ(read->time, written.time);
  }
}

TEST(CObservationTimedPoints, DamageIsAnErrorAndTakesNoMemory) {
  const std::string whole = bytesOf(sweep(3));
  EXPECT_ANY_THROW(readFrom(whole.substr(0, whole.size() / 2)));

  auto uneven = sweep(3);
  uneven.time.pop_back();
  EXPECT_ANY_THROW(readFrom(bytesOf(uneven)));

  std::string huge = whole;
  const size_t count = huge.find(std::string("\3\0\0\0\0\0\0\0", 8));
  ASSERT_NE(count, std::string::npos);
  huge[count + 6] = 1;
  EXPECT_ANY_THROW(readFrom(huge));
}

TEST(CObservationTimedPoints, TellsAndShowsWhatItHolds) {
  std::ostringstream text;
  sweep(3).getDescriptionAsText(text);
  EXPECT_THAT(text.str(), HasSubstr("spot/ouster"));
  EXPECT_THAT(text.str(), HasSubstr("Points: 3 with intensity"));
  mrpt::opengl::CSetOfObjects scene;
  sweep(3).getVisualizationInto(scene);
  EXPECT_EQ(scene.size(), 1u);
  EXPECT_NEAR(scene.getBoundingBox().max.x, 2, 3) << "at the sensor";
  sweep(0).getVisualizationInto(scene);
  EXPECT_EQ(scene.size(), 2u);
}

TEST(CObservationTimedPoints, RawlogEditReadsItWithTheLibraryAsAPlugin) {
  if (!std::filesystem::exists(kRawlogEdit)) GTEST_SKIP() << kRawlogEdit << " is not installed";
  const std::string folder = freshFolder(), rawlog = folder + "/timed.rawlog";
  {
    mrpt::io::CFileGZOutputStream file(rawlog);
    auto archive = mrpt::serialization::archiveFrom(file);
    for (int i = 0; i < 4; ++i) archive << sweep(10);
  }
  const std::string command = kRawlogEdit + " -p " LAMP_OBSERVATIONS " --info -i " + rawlog +
                              " > " + folder + "/info.txt 2>&1";
  EXPECT_EQ(std::system(command.c_str()), 0);
  std::ifstream file(folder + "/info.txt");
  const std::string info{std::istreambuf_iterator<char>(file), {}};
  EXPECT_THAT(info, HasSubstr("spot/ouster"));
  EXPECT_THAT(info, testing::ContainsRegex("number of objects +: 4"));
}

}  // namespace
}  // namespace lamp
