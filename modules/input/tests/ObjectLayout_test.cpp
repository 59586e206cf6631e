/** What MRPT writes is read whole; what is altered of it is refused, whatever the byte. */
#include "ObjectLayout.h"

#include <gmock/gmock.h>
#include <mrpt/maps/CColouredPointsMap.h>
#include <mrpt/maps/CWeightedPointsMap.h>
#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CActionRobotMovement2D.h>
#include <mrpt/obs/CActionRobotMovement3D.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CObservation3DRangeScan.h>
#include <mrpt/obs/CObservationBeaconRanges.h>
#include <mrpt/obs/CObservationBearingRange.h>
#include <mrpt/obs/CObservationComment.h>
#include <mrpt/obs/CObservationGPS.h>
#include <mrpt/obs/CObservationIMU.h>
#include <mrpt/obs/CObservationImage.h>
#include <mrpt/obs/CObservationRotatingScan.h>
#include <mrpt/obs/CObservationVelodyneScan.h>
#include <mrpt/obs/CObservationWirelessPower.h>
#include <mrpt/obs/CSensoryFrame.h>
#include <mrpt/poses/CPosePDFParticles.h>
#include <sys/resource.h>

#include "RecordingTools.h"
#include "RewindableStream.h"
#include "lamp/input/RawlogReader.h"
#include "lamp/observations/CObservationTimedPoints.h"

namespace lamp {
namespace {

using namespace test;
using namespace mrpt::obs;
using mrpt::serialization::CSerializable;
using testing::HasSubstr;

std::shared_ptr<CObservation2DRangeScan> laser(bool intensity) {
  auto scan = CObservation2DRangeScan::Create();
  scan->resizeScanAndAssign(9, 2.0f, true);
  scan->setScanHasIntensity(intensity);
  return scan;
}
template <class Map>
std::shared_ptr<CObservationPointCloud> cloudOf() {
  auto scan = CObservationPointCloud::Create();
  auto map = Map::Create();
  for (int i = 0; i < 5; ++i) map->insertPoint(1.0f, 2.0f, 3.0f);
  scan->pointcloud = map;
  return scan;
}
std::shared_ptr<CObservationPointCloud> cloudInOtherFile() {
  auto scan = CObservationPointCloud::Create();
  scan->setAsExternalStorage("cloud.bin",
                             CObservationPointCloud::ExternalStorageFormat::MRPT_Serialization);
  return scan;
}
std::shared_ptr<CObservationTimedPoints> timedPoints() {
  auto scan = std::make_shared<CObservationTimedPoints>();
  scan->x = scan->y = scan->z = scan->time = {1, 2, 3};
  return scan;
}
std::shared_ptr<CObservationRotatingScan> rotatingScan() {
  auto scan = CObservationRotatingScan::Create();
  scan->rowCount = 2;
  scan->columnCount = 3;
  scan->rangeImage.setZero(2, 3);
  scan->intensityImage.setZero(2, 3);
  scan->rangeOtherLayers["strongest"].setZero(2, 3);
  return scan;
}
std::shared_ptr<CObservationVelodyneScan> velodyneScan() {
  auto scan = CObservationVelodyneScan::Create();
  scan->scan_packets.resize(1);
  scan->calibration = VelodyneCalibration::LoadDefaultCalibration("VLP16");
  auto& cloud = scan->point_cloud;
  cloud.x = cloud.y = cloud.z = cloud.azimuth = {1, 2};
  cloud.intensity = {3, 4};
  cloud.timestamp.resize(2);
  cloud.laser_id = {0, 1};
  cloud.pointsForLaserID = {{0}, {1}, {}};
  return scan;
}
std::shared_ptr<CObservation3DRangeScan> depthScan() {
  auto scan = CObservation3DRangeScan::Create();
  scan->hasPoints3D = true;
  scan->resizePoints3DVectors(4);
  scan->hasRangeImage = true;
  scan->rangeImage_setSize(2, 3);
  scan->hasIntensityImage = true;
  scan->intensityImage.resize(8, 4, mrpt::img::CH_RGB);
  scan->hasConfidenceImage = true;
  scan->confidenceImage.resize(8, 4, mrpt::img::CH_GRAY);
  scan->rangeImageOtherLayers["last"].setZero(2, 3);
  auto labels = std::make_shared<TPixelLabelInfo<2>>();
  labels->setSize(2, 3);
  labels->setLabelName(1, "wall");
  scan->pixelLabels = labels;
  return scan;
}
std::shared_ptr<CActionRobotMovement2D> motion(bool particles) {
  auto motion = CActionRobotMovement2D::Create();
  motion->hasVelocities = motion->hasEncodersInfo = true;
  if (!particles) return motion;
  motion->estimationMethod = CActionRobotMovement2D::emScan2DMatching;
  auto pdf = mrpt::poses::CPosePDFParticles::Create();
  pdf->resetDeterministic({1, 2, 3}, 4);
  motion->poseChange = pdf;
  return motion;
}
std::shared_ptr<CActionRobotMovement2D> drawnMotion() {
  auto drawn = CActionRobotMovement2D::Create();
  CActionRobotMovement2D::TMotionModelOptions model;
  model.modelSelection = CActionRobotMovement2D::mmThrun;
  drawn->computeFromOdometry({1, 0, 0}, model);
  return drawn;
}
std::shared_ptr<CObservationBearingRange> sightings(bool covariances) {
  auto seen = CObservationBearingRange::Create();
  seen->validCovariances = covariances;
  seen->sensedData.resize(2);
  seen->sensedData[1].landmarkID = 7;
  return seen;
}
std::shared_ptr<CObservationBeaconRanges> ranges() {
  auto heard = CObservationBeaconRanges::Create();
  heard->sensedData.resize(2);
  return heard;
}
std::shared_ptr<CObservationImage> image() {
  auto taken = CObservationImage::Create();
  taken->image.resize(8, 4, mrpt::img::CH_RGB);
  return taken;
}
std::shared_ptr<CObservationComment> comment() {
  auto text = CObservationComment::Create();
  text->text = "made by a test";
  return text;
}

/** One object or more of each class that has a layout. */
Objects everyKind() {
  auto frame = CSensoryFrame::Create();
  frame->insert(laser(false));
  frame->insert(timedPoints());
  auto actions = CActionCollection::Create();
  for (const bool particles : {false, true}) actions->insert(*motion(particles));
  actions->insert(*drawnMotion());
  CActionRobotMovement3D spatial;
  actions->insert(spatial);
  Objects objects{laser(true),
                  cloudOf<mrpt::maps::CSimplePointsMap>(),
                  cloudOf<mrpt::maps::CPointsMapXYZI>(),
                  cloudOf<mrpt::maps::CColouredPointsMap>(),
                  cloudOf<mrpt::maps::CWeightedPointsMap>(),
                  CObservationPointCloud::Create(),
                  cloudInOtherFile(),
                  timedPoints(),
                  rotatingScan(),
                  velodyneScan(),
                  depthScan(),
                  CObservation3DRangeScan::Create(),
                  CObservationOdometry::Create(),
                  CObservationRobotPose::Create(),
                  CObservationIMU::Create(),
                  sightings(true),
                  sightings(false),
                  ranges(),
                  CObservationWirelessPower::Create(),
                  comment(),
                  image(),
                  frame,
                  actions};
  for (const auto& object : objects) {
    if (const auto o = std::dynamic_pointer_cast<CObservation>(object)) o->sensorLabel = "sensor";
  }
  return objects;
}

TEST(ObjectLayout, EndsWhereMrptEndsWhateverTheClass) {
  const std::string path = freshFolder() + "/one.rawlog";
  for (const auto& object : everyKind()) {
    const std::string bytes = bytesOf(*object);
    writeFile(path, bytes + "more");
    RewindableStream stream(path);
    const ObjectLayout layout = layoutOf(stream);
    EXPECT_EQ(layout.end, bytes.size()) << object->GetRuntimeClass()->className;
    const auto* const depth = dynamic_cast<const CObservation3DRangeScan*>(object.get());
    const bool pictures = depth && depth->hasIntensityImage;
    EXPECT_EQ(layout.pictures.size(), pictures ? 2u : IS_CLASS(*object, CObservationImage) ? 1 : 0);
  }
}

TEST(ObjectLayout, WhatIsReadIsWhatWasWritten) {
  const std::string path = freshFolder() + "/one.rawlog";
  for (const auto& object : everyKind()) {
    if (IS_CLASS(*object, CObservationComment)) continue;
    const std::string bytes = bytesOf(*object);
    writeFile(path, bytes);
    RawlogReader reader(path);
    const auto read = reader.next();
    ASSERT_TRUE(read) << object->GetRuntimeClass()->className;
    if (auto* const depth = dynamic_cast<CObservation3DRangeScan*>(read.get());
        depth && depth->hasIntensityImage) {
      EXPECT_TRUE(depth->intensityImage.isExternallyStored()) << "pictures are not decoded";
      EXPECT_EQ(depth->rangeImage.rows(), 2);
      EXPECT_EQ(depth->points3D_x.size(), 4u);
    } else if (auto* const taken = dynamic_cast<CObservationImage*>(read.get())) {
      EXPECT_TRUE(taken->image.isExternallyStored());
      EXPECT_EQ(taken->sensorLabel, "sensor");
    } else if (!IS_CLASS(*object, CActionCollection)) {  // MRPT draws particles anew
      EXPECT_EQ(bytesOf(*read), bytes) << object->GetRuntimeClass()->className;
    }
    EXPECT_EQ(reader.report().bytes_skipped, 0u);
  }
}

/** A recording of altered objects, each between two that are not. Those must all be read, and if
 * something is lost, a message says where. It is not periodic, since what a size that is too large
 * takes in must not end just as another object does. */
class AlteredRecording {
 public:
  void add(const std::string& altered) { bytes_ += bytesOf(*wheels(++whole_, "wheels")) + altered; }
  void read() const {
    const std::string path = freshFolder() + "/altered.rawlog";
    writeFile(path, bytes_ + bytesOf(*wheels(static_cast<double>(whole_ + 1), "")));
    RawlogReader reader(path);
    size_t whole = 0;
    while (const auto object = reader.next()) {
      const auto odometry = std::dynamic_pointer_cast<CObservationOdometry>(object);
      if (odometry && mrpt::Clock::toDouble(odometry->timestamp) == static_cast<double>(whole + 1))
        ++whole;
    }
    EXPECT_EQ(whole, whole_ + 1);
    EXPECT_GT(reader.report().damaged_objects, 0u);
    ASSERT_FALSE(reader.report().messages.empty());
    EXPECT_THAT(reader.report().messages.front(), HasSubstr("byte "));
  }

 private:
  size_t whole_ = 0;
  std::string bytes_;
};

/** Each place of an object; of large arrays, some. */
std::vector<size_t> placesIn(const std::string& bytes, size_t length) {
  std::vector<size_t> places;
  for (size_t i = 0; i + length <= bytes.size(); i += i < 700 ? 1 : 13) places.push_back(i);
  return places;
}

TEST(ObjectLayout, NoAlteredByteDoesHarm) {
  for (const auto& object : everyKind()) {
    SCOPED_TRACE(object->GetRuntimeClass()->className);
    const std::string bytes = bytesOf(*object);
    AlteredRecording recording;
    for (const size_t place : placesIn(bytes, 1)) {
      for (const char* value : {"\x00", "\x7f", "\xff"})
        recording.add(std::string(bytes).replace(place, 1, value, 1));
    }
    recording.read();
  }
}

TEST(ObjectLayout, SizesThatAreTooLargeAreDamage) {
  for (const auto& object : everyKind()) {
    SCOPED_TRACE(object->GetRuntimeClass()->className);
    const std::string bytes = bytesOf(*object);
    AlteredRecording recording;
    for (const size_t place : placesIn(bytes, 4)) {
      for (const char* value : {"\xff\xff\xff\xff", "\xff\xff\xff\x7f", "\xff\xff\xff\x0f"})
        recording.add(std::string(bytes).replace(place, 4, value, 4));
    }
    recording.read();
  }
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  EXPECT_LT(usage.ru_maxrss, 1 << 20) << "KiB";
}

TEST(ObjectLayout, ParticlesAsManyAsTheMotionModelSaysAreNotDrawn) {
  CActionCollection actions;
  actions.insert(*drawnMotion());
  std::string bytes = bytesOf(actions);
  const size_t particles = bytes.find(std::string("\x2c\x01\0\0", 4));  // 300
  ASSERT_NE(particles, std::string::npos);
  bytes.replace(particles, 4, "\xff\xff\xff\x3f");
  AlteredRecording recording;
  recording.add(bytes);
  recording.read();
}

TEST(ObjectLayout, AFrameHoldsNoNothing) {
  std::string frame = bytesOf(CSensoryFrame());
  frame.replace(frame.size() - 5, 5, std::string("\x01\0\0\0\x87nullptr\x88\x88", 14));
  AlteredRecording recording;
  recording.add(frame);
  recording.read();
}

TEST(ObjectLayout, AFlagIsSetOrNot) {
  CObservationIMU unit;
  unit.dataIsPresent.fill(true);
  std::string bytes = bytesOf(unit);
  const size_t flags = bytes.find(std::string(31, '\x01'));
  ASSERT_NE(flags, std::string::npos);
  bytes[flags + 7] = '\x1f';
  AlteredRecording recording;
  recording.add(bytes);
  recording.read();
}

TEST(ObjectLayout, PointsHaveThreeCoordinates) {
  auto scan = velodyneScan();
  scan->point_cloud.y.pop_back();
  AlteredRecording recording;
  recording.add(bytesOf(*scan));
  recording.read();
}

TEST(ObjectLayout, APartOfAnotherClassIsDamage) {
  const std::string path = freshFolder() + "/part.rawlog";
  std::string bytes = bytesOf(*cloud(2, "lidar"));
  const std::string map = "mrpt::maps::CSimplePointsMap", other = "mrpt::maps::COccupancyGridMap2D";
  const size_t name = bytes.find(map);
  bytes.replace(name - 1, map.size() + 1, static_cast<char>(0x80 | other.size()) + other);
  writeFile(path, bytesOf(*cloud(1, "lidar")) + bytes + bytesOf(*cloud(3, "lidar")));
  RawlogReader reader(path);
  size_t clouds = 0;
  while (reader.next()) ++clouds;
  EXPECT_EQ(clouds, 2u);
  EXPECT_EQ(reader.report().damaged_objects, 1u);
  EXPECT_EQ(reader.report().bytes_skipped, bytes.size());
}

TEST(ObjectLayout, ClassesWithoutUseArePassedOverAndTheRestOfAFrameIsRead) {
  const std::string path = freshFolder() + "/gps.rawlog";
  auto gps = CObservationGPS::Create();
  gps->sensorLabel = "gps";
  CSensoryFrame frame;
  for (const CObservation::Ptr& o : {CObservation::Ptr(wheels(1, "odometry")),
                                     CObservation::Ptr(gps), CObservation::Ptr(wheels(2, "x"))})
    frame.insert(o);
  writeFile(path, bytesOf(*gps) + bytesOf(frame) + bytesOf(*gps) + bytesOf(*wheels(3, "odometry")));
  RawlogReader reader(path);
  std::vector<double> stamps;
  while (const auto object = reader.next()) {
    const auto odometry = std::dynamic_pointer_cast<CObservationOdometry>(object);
    ASSERT_TRUE(odometry);
    stamps.push_back(mrpt::Clock::toDouble(odometry->timestamp));
  }
  EXPECT_THAT(stamps, testing::ElementsAre(1, 2, 3));
  EXPECT_EQ(reader.report().bytes_skipped, 0u);
  EXPECT_EQ(reader.report().damaged_objects, 0u);
  EXPECT_TRUE(reader.report().messages.empty());
}

}  // namespace
}  // namespace lamp
