#include <fuzzer/FuzzedDataProvider.h>
#include <mrpt/core/backtrace.h>
#include <mrpt/io/CMemoryStream.h>
#include <mrpt/maps/CPointsMapXYZI.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CObservationBeaconRanges.h>
#include <mrpt/obs/CObservationBearingRange.h>
#include <mrpt/obs/CObservationIMU.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/CObservationPointCloud.h>
#include <mrpt/obs/CObservationRobotPose.h>
#include <mrpt/obs/CObservationRotatingScan.h>
#include <mrpt/obs/CSensoryFrame.h>
#include <mrpt/serialization/CArchive.h>

#include "FuzzTarget.h"
#include "lamp/input/ExtrasFromObservation.h"
#include "lamp/input/OdometryFromObservation.h"
#include "lamp/input/RawlogSource.h"
#include "lamp/input/ScanFromObservation.h"

using namespace lamp;
using namespace mrpt::obs;

/** In place of MRPT's own: each of its exceptions looks up the names of the functions on the stack,
 * which takes far longer than to read an object. */
void mrpt::callStackBackTrace(TCallStackBackTrace&, const unsigned int,
                              const unsigned int) noexcept {}

namespace {

/** A recording of whole objects with any values, and between them what damage leaves. The bytes of
 * an object are not altered: MRPT trusts the sizes and classes in them (RawlogReader.h). */
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
    switch (fuzz_.ConsumeIntegralInRange(0, 9)) {
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
        return appendFrame();
      default:
        appendDamage();
    }
  }

  void append(const mrpt::serialization::CSerializable& object) {
    try {
      bytes_ += serialized(object);
      ++objects_;
    } catch (const std::exception&) {  // MRPT writes no observation that contradicts itself
    }
  }
  void appendFrame() {
    CSensoryFrame frame;
    frame.insert(std::make_shared<CObservation2DRangeScan>(laser()));
    append(frame);
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
    fuzz::require(report.objects == recording.objects(), "all objects are read");
    fuzz::require(report.bytes_skipped == 0 && !report.truncated, "nothing is lost");
  });
  return 0;
}
