#include <fuzzer/FuzzedDataProvider.h>
#include <mrpt/core/backtrace.h>
#include <mrpt/io/CMemoryStream.h>
#include <mrpt/maps/CPointsMapXYZI.h>
#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CActionRobotMovement2D.h>
#include <mrpt/obs/CActionRobotMovement3D.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CObservation3DRangeScan.h>
#include <mrpt/obs/CObservationBeaconRanges.h>
#include <mrpt/obs/CObservationBearingRange.h>
#include <mrpt/obs/CObservationIMU.h>
#include <mrpt/obs/CObservationImage.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/CObservationPointCloud.h>
#include <mrpt/obs/CObservationRobotPose.h>
#include <mrpt/obs/CObservationRotatingScan.h>
#include <mrpt/obs/CObservationVelodyneScan.h>
#include <mrpt/obs/CSensoryFrame.h>
#include <mrpt/serialization/CArchive.h>

#include "FuzzTarget.h"
#include "lamp/input/ExtrasFromObservation.h"
#include "lamp/input/OdometryFromObservation.h"
#include "lamp/input/RawlogSource.h"
#include "lamp/input/ScanFromObservation.h"
#include "lamp/observations/CObservationTimedPoints.h"

using namespace lamp;
using namespace mrpt::obs;

/** In place of MRPT's own: each of its exceptions looks up the names of the functions on the stack,
 * which takes far longer than to read an object. */
void mrpt::callStackBackTrace(TCallStackBackTrace&, const unsigned int,
                              const unsigned int) noexcept {}

namespace {

/** A recording of objects with any values, some with altered bytes, and between them what damage
 * leaves. */
class Recording {
 public:
  Recording(const uint8_t* data, size_t size) : fuzz_(data, size) {
    while (fuzz_.remaining_bytes() > 0) append();
  }
  const std::string& bytes() const { return bytes_; }
  bool damaged() const { return damaged_; }
  size_t objects() const { return objects_; }

 private:
  void append() {
    switch (fuzz_.ConsumeIntegralInRange(0, 14)) {
      case 0:
        return append(laser());
      case 1:
        return append(cloud());
      case 2:
        return append(rotating());
      case 3:
        return append(wheels());
      case 4:
        return append(pose());
      case 5:
        return append(inertial());
      case 6:
        return append(sightings());
      case 7:
        return append(ranges());
      case 8:
        return append(frame());
      case 9:
        return append(depth());
      case 10:
        return append(packets());
      case 11:
        return append(timed());
      case 12:
        return append(picture());
      case 13:
        return append(actions());
      default:
        appendDamage();
    }
  }

  void append(const mrpt::serialization::CSerializable& object) {
    try {
      bytes_ += maybeAltered(serialized(object));
      ++objects_;
    } catch (const std::exception&) {  // MRPT writes no observation that contradicts itself
    }
  }
  std::string maybeAltered(std::string bytes) {
    while (fuzz_.ConsumeBool()) {
      damaged_ = true;
      const size_t place = fuzz_.ConsumeIntegralInRange<size_t>(0, bytes.size() - 1);
      const std::string altered =
          fuzz_.ConsumeBytesAsString(1 + fuzz_.ConsumeIntegralInRange(0, 3));
      bytes.replace(place, altered.size(), altered);
    }
    return bytes;
  }
  /** Bytes of no meaning, or an object whose end is lost. */
  void appendDamage() {
    damaged_ = true;
    const std::string lost = serialized(wheels());
    bytes_ += fuzz_.ConsumeBool()
                  ? fuzz_.ConsumeRandomLengthString(40)
                  : lost.substr(0, fuzz_.ConsumeIntegralInRange<size_t>(0, lost.size()));
  }

  static std::string serialized(const mrpt::serialization::CSerializable& object) {
    mrpt::io::CMemoryStream memory;
    mrpt::serialization::archiveFrom(memory) << object;
    return {static_cast<const char*>(memory.getRawBufferData()), memory.getTotalBytesCount()};
  }

  /** Any double or float: small ones, huge ones, and those that are no numbers. */
  template <class T>
  T any() {
    T value{};
    fuzz_.ConsumeData(&value, sizeof(T));
    return value;
  }
  int count() { return fuzz_.ConsumeIntegralInRange(0, 12); }
  mrpt::poses::CPose3D anyPose() {
    return {any<double>(), any<double>(), any<double>(),
            any<double>(), any<double>(), any<double>()};
  }
  template <class Observation>
  Observation made() {
    Observation observation;
    observation.timestamp = mrpt::Clock::time_point(mrpt::Clock::duration(
        fuzz_.ConsumeBool() ? any<int64_t>() : 130'000'000'000'000'000 + count()));
    observation.sensorLabel = fuzz_.ConsumeRandomLengthString(8);
    return observation;
  }

  CObservation2DRangeScan laser() {
    auto scan = made<CObservation2DRangeScan>();
    scan.sensorPose = anyPose();
    scan.aperture = any<float>();
    scan.maxRange = any<float>();
    scan.resizeScan(static_cast<size_t>(count()));
    for (size_t i = 0; i < scan.getScanSize(); ++i) {
      scan.setScanRange(i, any<float>());
      scan.setScanRangeValidity(i, fuzz_.ConsumeBool());
    }
    return scan;
  }
  CObservationPointCloud cloud() {
    auto scan = made<CObservationPointCloud>();
    scan.sensorPose = anyPose();
    auto points = mrpt::maps::CPointsMapXYZI::Create();
    for (int i = count(); i > 0; --i) points->insertPoint(any<float>(), any<float>(), any<float>());
    if (fuzz_.ConsumeBool()) scan.pointcloud = points;
    return scan;
  }
  CObservationRotatingScan rotating() {
    auto scan = made<CObservationRotatingScan>();
    scan.sensorPose = anyPose();
    scan.rowCount = static_cast<uint16_t>(count());
    scan.columnCount = static_cast<uint16_t>(count());
    scan.rangeResolution = any<double>();
    scan.rangeImage.resize(count(), count());
    scan.rangeImage.fill(fuzz_.ConsumeIntegral<uint16_t>());
    scan.intensityImage.resize(count(), count());
    return scan;
  }
  CObservationOdometry wheels() {
    auto odometry = made<CObservationOdometry>();
    odometry.odometry = mrpt::poses::CPose2D(any<double>(), any<double>(), any<double>());
    return odometry;
  }
  CObservationRobotPose pose() {
    auto odometry = made<CObservationRobotPose>();
    odometry.sensorPose = anyPose();
    odometry.pose.mean = anyPose();
    for (int i = 0; i < 6; ++i) odometry.pose.cov(i, i) = any<double>();
    return odometry;
  }
  CObservationIMU inertial() {
    auto unit = made<CObservationIMU>();
    unit.sensorPose = anyPose();
    for (const auto i :
         {IMU_X_ACC, IMU_Y_ACC, IMU_Z_ACC, IMU_YAW_VEL, IMU_PITCH_VEL, IMU_ROLL_VEL}) {
      unit.dataIsPresent[i] = fuzz_.ConsumeBool();
      unit.rawMeasurements[i] = any<double>();
    }
    return unit;
  }
  CObservationBearingRange sightings() {
    auto seen = made<CObservationBearingRange>();
    seen.setSensorPose(anyPose());
    seen.sensor_std_range = any<float>();
    seen.sensedData.resize(static_cast<size_t>(count()));
    for (auto& one : seen.sensedData) {
      one.landmarkID = any<int32_t>();
      one.range = any<float>();
      one.yaw = any<float>();
    }
    return seen;
  }
  CObservationBeaconRanges ranges() {
    auto heard = made<CObservationBeaconRanges>();
    heard.stdError = any<float>();
    heard.maxSensorDistance = any<float>();
    heard.sensedData.resize(static_cast<size_t>(count()));
    for (auto& one : heard.sensedData) {
      one.beaconID = any<int32_t>();
      one.sensedDistance = any<float>();
    }
    return heard;
  }

  CSensoryFrame frame() {
    CSensoryFrame frame;
    frame.insert(std::make_shared<CObservation2DRangeScan>(laser()));
    frame.insert(std::make_shared<CObservationIMU>(inertial()));
    return frame;
  }
  CObservation3DRangeScan depth() {
    auto scan = made<CObservation3DRangeScan>();
    scan.sensorPose = anyPose();
    scan.maxRange = any<float>();
    scan.hasPoints3D = fuzz_.ConsumeBool();
    if (scan.hasPoints3D) scan.resizePoints3DVectors(static_cast<size_t>(count()));
    scan.hasRangeImage = fuzz_.ConsumeBool();
    if (scan.hasRangeImage) {
      scan.rangeImage_setSize(count(), count());
      scan.rangeImage.fill(fuzz_.ConsumeIntegral<uint16_t>());
    }
    scan.cameraParams.setIntrinsicParamsFromValues(any<double>(), any<double>(), any<double>(),
                                                   any<double>());
    return scan;
  }
  CObservationVelodyneScan packets() {
    auto scan = made<CObservationVelodyneScan>();
    scan.sensorPose = anyPose();
    scan.scan_packets.resize(static_cast<size_t>(fuzz_.ConsumeIntegralInRange(0, 2)));
    for (auto& packet : scan.scan_packets) fuzz_.ConsumeData(&packet, sizeof(packet));
    if (fuzz_.ConsumeBool())
      scan.calibration = VelodyneCalibration::LoadDefaultCalibration("VLP16");
    auto& cloud = scan.point_cloud;
    for (int i = count(); i > 0; --i) {
      for (auto* axis : {&cloud.x, &cloud.y, &cloud.z}) axis->push_back(any<float>());
      cloud.intensity.push_back(0);
    }
    return scan;
  }
  CObservationTimedPoints timed() {
    auto scan = made<CObservationTimedPoints>();
    scan.sensorPose = anyPose();
    for (int i = count(); i > 0; --i) {
      for (auto* column : {&scan.x, &scan.y, &scan.z, &scan.time}) column->push_back(any<float>());
    }
    return scan;
  }
  CObservationImage picture() {
    auto taken = made<CObservationImage>();
    taken.image.resize(count(), count(), mrpt::img::CH_GRAY);
    return taken;
  }
  CActionCollection actions() {
    CActionCollection actions;
    CActionRobotMovement2D planar;
    CActionRobotMovement2D::TMotionModelOptions model;
    if (fuzz_.ConsumeBool()) model.modelSelection = CActionRobotMovement2D::mmThrun;
    planar.computeFromOdometry({any<double>(), any<double>(), any<double>()}, model);
    actions.insert(planar);
    if (fuzz_.ConsumeBool()) {
      CActionRobotMovement3D spatial;
      spatial.poseChange.mean = anyPose();
      actions.insert(spatial);
    }
    return actions;
  }

  FuzzedDataProvider fuzz_;
  std::string bytes_;
  bool damaged_ = false;
  size_t objects_ = 0;
};

/** All that the front end asks of an observation. */
void use(const InputObservation& input) {
  fuzz::require(std::isfinite(input.stamp), "a stamp is a number");
  try {
    if (const auto scan = scanFromObservation(*input.observation, input.label, {}))
      for (const Eigen::Vector3f& point : scan->points)
        fuzz::require(point.allFinite(), "finite points");
  } catch (const std::exception&) {  // the front end counts scans that cannot be read
  }
  if (const auto odometry = odometryFromObservation(*input.observation))
    fuzz::require(isFinite(odometry->odom_T_base), "finite odometry");
  if (const auto felt = inertialFromObservation(input))
    fuzz::require(felt->specific_force.allFinite() && felt->angular_velocity.allFinite(),
                  "finite inertial readings");
  for (const LandmarkSighting& seen : sightingsFromObservation(input))
    fuzz::require(seen.base_p_landmark.allFinite() && seen.sigma_m > 0, "finite landmarks");
  for (const RangeReading& heard : rangesFromObservation(input))
    fuzz::require(std::isfinite(heard.range_m) && heard.sigma_m > 0, "finite ranges");
}

}  // namespace

/** Without damage every object is read, whatever its values; with damage what is left is. */
extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  const Recording recording(data, size);
  const std::string& bytes = recording.bytes();
  const std::string path =
      fuzz::fileOf(reinterpret_cast<const uint8_t*>(bytes.data()), bytes.size(), ".rawlog");
  fuzz::mayRefuse(path, [&] {
    RobotTable robots;
    RawlogSource source({path}, {}, robots);
    while (const auto input = source.next()) use(*input);
    const RawlogReport report = source.recordings().at(0).file;
    if (recording.damaged()) return;
    const std::string lost = report.messages.empty() ? "" : ": " + report.messages.front();
    fuzz::require(report.objects == recording.objects(), "all objects are read" + lost);
    fuzz::require(report.bytes_skipped == 0 && !report.truncated, "nothing is lost" + lost);
  });
  return 0;
}
