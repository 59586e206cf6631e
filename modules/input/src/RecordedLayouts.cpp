#include <mrpt/obs/CAction.h>
#include <mrpt/obs/CActionRobotMovement2D.h>
#include <mrpt/obs/CObservation.h>
#include <mrpt/obs/CObservationIMU.h>
#include <mrpt/obs/CObservationVelodyneScan.h>

#include <stdexcept>

#include "ClassLayouts.h"
#include "LayoutCursor.h"

namespace lamp {
namespace {

using namespace classes;

constexpr size_t kFloat = 4, kDouble = 8, kStamp = 8;

void frame(LayoutCursor& in, int version) {
  if (version < 2) in.skip(4);
  if (version == 0) in.skip(kStamp);
  for (uint32_t left = in.number(); left > 0; --left) in.entry(CLASS_ID(mrpt::obs::CObservation));
}
void actions(LayoutCursor& in, int) {
  for (uint32_t left = in.number(); left > 0; --left) in.entry(CLASS_ID(mrpt::obs::CAction));
}

/** MRPT draws as many particles as the motion model says. */
void motionModel(LayoutCursor& in, int version) {
  constexpr uint32_t kMaxParticles = 100'000;
  const bool gaussian = in.number() == mrpt::obs::CActionRobotMovement2D::mmGaussian;
  in.array(version == 3 ? 5 : 6, kFloat);
  const uint32_t particles = in.number();
  if (!gaussian && particles > kMaxParticles) throw std::runtime_error("too many particles");
  in.array(version < 5 ? 4 : 6, kFloat);
}
void planarIncrement(LayoutCursor& in, int version) {
  in.part({kPose2D});
  if (version >= 3) return motionModel(in, version);
  in.skip(44);
}
void movement2D(LayoutCursor& in, int version) {
  if (version < 2) in.part({kPoseGaussian, kPoseParticles});
  const bool odometry = in.number() == mrpt::obs::CActionRobotMovement2D::emOdometry;
  if (version >= 2) {
    odometry ? planarIncrement(in, version) : in.part({kPoseGaussian, kPoseParticles});
  }
  if (version == 0) return;
  const bool velocities = in.unusedFlag();
  if (version < 7) in.skip(2 * kFloat);
  if (version >= 7 && velocities) in.skip(3 * kDouble);
  const bool encoders = in.unusedFlag();
  if (version < 7 || encoders) in.skip(8);
  if (version >= 6) in.skip(kStamp);
}
void movement3D(LayoutCursor& in, int version) {
  in.skip(4);
  in.part({kPose3DGaussian});
  in.list(1);
  in.list(kFloat);
  if (version >= 1) in.skip(kStamp);
}

void laser(LayoutCursor& in, int version) {
  in.skip(kFloat);
  in.flag();
  in.skip(kFloat);
  in.part({kPose3D});
  if (version < 6) in.part({kMatrixF});
  const uint32_t rays = in.number();
  in.array(rays, kFloat);
  if (version >= 1) in.array(rays, 1);
  if (version >= 2) in.skip(kFloat);
  if (version >= 3) in.skip(kStamp);
  if (version >= 4) in.skip(kFloat);
  if (version >= 5) {
    in.text();
    in.skip(kDouble);
  }
  if (version >= 7 && in.flag()) in.array(rays, 4);
}

void pointCloud(LayoutCursor& in, int) {
  in.text();
  in.skip(kStamp);
  in.part({kPose3D});
  const bool in_other_file = in.byte() != 0;
  if (in_other_file) return in.text();
  in.optionalPart({kSimplePoints, kPointsXYZI, kColouredPoints, kWeightedPoints});
}

void timedPoints(LayoutCursor& in, int) {
  in.text();
  in.skip(kStamp);
  in.part({kPose3D});
  for (int column = 0; column < 5; ++column) in.array(in.longNumber(), kFloat);
}

void rotatingScan(LayoutCursor& in, int) {
  in.skip(kStamp);
  in.text();
  in.skip(4 + 4 * kDouble);
  in.text();
  in.skip(2 * kDouble);
  in.part({kPose3D});
  in.skip(kStamp);
  in.flag();
  const uint64_t columns = in.shortNumber(), rows = in.shortNumber();
  in.array(rows * columns, 2);
  const uint64_t intensity_columns = in.shortNumber();
  in.array(intensity_columns * in.shortNumber(), 1);
  const uint16_t layers = in.shortNumber();
  if (layers > 0 && rows * columns == 0) throw std::runtime_error("layers without a size");
  for (uint16_t i = 0; i < layers; ++i) {
    in.text();
    in.array(rows * columns, 2);
  }
}

void velodyneScan(LayoutCursor& in, int version) {
  using Scan = mrpt::obs::CObservationVelodyneScan;
  in.skip(kStamp);
  in.text();
  in.skip(2 * kDouble);
  in.part({kPose3D});
  in.list(sizeof(Scan::TVelodyneRawPacket));
  in.list(sizeof(mrpt::obs::VelodyneCalibration::PerLaserCalib));
  in.coordinates();
  in.list(1);
  if (version >= 1) in.flag();
  if (version < 2) return;
  const auto typeNames = [&] {
    in.text();
    in.text();
  };
  typeNames();
  in.list(kStamp);
  in.list(kFloat);
  in.list(2);
  typeNames();
  for (uint32_t lasers = in.number(); lasers > 0; --lasers) in.list(8);
}

void pixelLabels(LayoutCursor& in) {
  in.skip(1);
  const uint8_t bytes_each = in.byte();
  if (bytes_each == 0) throw std::runtime_error("labels without a size");
  const uint32_t rows = in.number();
  in.grid(rows, in.number(), bytes_each);
  // MRPT loses the memory of the labels if one of these is another.
  for (const char* type : {"std::map", "uint32_t", "std::string"}) in.text(type);
  for (uint32_t names = in.number(); names > 0; --names) {
    in.skip(4);
    in.text();
  }
}
void rangeImage(LayoutCursor& in) {
  const uint32_t rows = in.number();
  in.grid(rows, in.number(), 2);
}
void depthImages(LayoutCursor& in, int version) {
  const bool has_ranges = in.flag();
  if (version >= 9) in.skip(kFloat);
  if (has_ranges) version >= 9 ? rangeImage(in) : in.part({kMatrixF});
  for (int image = 0; image < 2; ++image) {
    if (in.flag()) in.picture();
  }
  if (version >= 2) in.part({kCamera});
  if (version < 4) return;
  in.part({kCamera});
  in.part({kPose3D});
}
void depthScan(LayoutCursor& in, int version) {
  in.skip(kFloat);
  in.part({kPose3D});
  const bool has_points = version == 0 || in.flag();
  if (has_points) in.list(3 * kFloat + (version == 0 ? 1 : 0) + (version >= 8 ? 4 : 0));
  if (version >= 1) depthImages(in, version);
  in.skip(kFloat + kStamp);
  in.text();
  for (int file = 0; version >= 3 && file < 2; ++file) {
    in.flag();
    in.text();
  }
  if (version >= 5) in.flag();
  if (version >= 6) in.skip(1);
  if (version >= 7 && in.flag()) pixelLabels(in);
  if (version < 10) return;
  for (uint8_t layers = in.byte(); layers > 0; --layers) {
    in.text();
    rangeImage(in);
  }
}

void wheelOdometry(LayoutCursor& in, int version) {
  in.part({kPose2D});
  in.text();
  in.skip(kStamp);
  if (version == 0) return;
  const bool encoders = in.unusedFlag();
  if (encoders || version < 2) in.skip(8);
  const bool velocities = in.unusedFlag();
  if (version < 2) {
    in.skip(2 * kFloat);
  } else if (velocities) {
    in.skip(3 * kDouble);
  }
}
void robotPose(LayoutCursor& in, int version) {
  in.part({kPose3DGaussian});
  in.text();
  in.skip(kStamp);
  if (version >= 1) in.part({kPose3D});
}

void inertialUnit(LayoutCursor& in, int version) {
  in.part({kPose3D});
  if (version >= 4) {
    for (int field = 0; field < mrpt::obs::COUNT_IMU_DATA_FIELDS; ++field) in.flag();
    in.skip(kStamp);
    in.array(mrpt::obs::COUNT_IMU_DATA_FIELDS, kDouble);
  } else {
    in.list(1);
    in.skip(kStamp);
    in.list(version == 0 ? kFloat : kDouble);
  }
  in.text();
}

void bearingsAndRanges(LayoutCursor& in, int version) {
  in.array(version >= 3 ? 4 : 3, kFloat);
  in.part({kPose3D});
  if (version >= 2) in.skip(kStamp);
  const bool covariances = version >= 3 && in.flag();
  if (version >= 3 && !covariances) in.array(3, kFloat);
  for (uint32_t sightings = in.number(); sightings > 0; --sightings) {
    in.skip(3 * kFloat + 4);
    if (covariances) in.part({kMatrixF, kMatrixD});
  }
  if (version >= 1) in.text();
}
void beaconRanges(LayoutCursor& in, int version) {
  in.array(3, kFloat);
  for (uint32_t ranges = in.number(); ranges > 0; --ranges) {
    in.part({kPoint3D});
    in.skip(kFloat + 4);
  }
  if (version >= 1) in.part({kPose2D});
  if (version >= 2) in.text();
  if (version >= 3) in.skip(kStamp);
}

void radioPower(LayoutCursor& in, int version) {
  in.skip(kDouble);
  if (version >= 1) in.text();
  if (version >= 2) in.skip(kStamp);
  if (version >= 3) in.part({kPose3D});
}

void comment(LayoutCursor& in, int) {
  in.list(1);
  in.skip(kStamp);
}
void image(LayoutCursor& in, int version) {
  if (version < 4) throw UnreadClass("CObservationImage as old releases wrote it");
  in.part({kPose3D});
  in.part({kCamera});
  in.picture();
  in.skip(kStamp);
  in.text();
}

}  // namespace

const ClassLayouts& recordedLayouts() {
  static const ClassLayouts layouts{
      {"mrpt::obs::CSensoryFrame", {frame, 0, 2}},
      {"mrpt::obs::CActionCollection", {actions, 0, 0}},
      {"mrpt::obs::CActionRobotMovement2D", {movement2D, 0, 7}},
      {"mrpt::obs::CActionRobotMovement3D", {movement3D, 0, 1}},
      {"mrpt::obs::CObservation2DRangeScan", {laser, 0, 7}},
      {"mrpt::obs::CObservationPointCloud", {pointCloud, 0, 0}},
      {"lamp::CObservationTimedPoints", {timedPoints, 0, 0}},
      {"mrpt::obs::CObservationRotatingScan", {rotatingScan, 0, 0}},
      {"mrpt::obs::CObservationVelodyneScan", {velodyneScan, 0, 2}},
      {"mrpt::obs::CObservation3DRangeScan", {depthScan, 0, 10}},
      {"mrpt::obs::CObservationOdometry", {wheelOdometry, 0, 2}},
      {"mrpt::obs::CObservationRobotPose", {robotPose, 0, 1}},
      {"mrpt::obs::CObservationIMU", {inertialUnit, 0, 4}},
      {"mrpt::obs::CObservationBearingRange", {bearingsAndRanges, 0, 3}},
      {"mrpt::obs::CObservationBeaconRanges", {beaconRanges, 0, 3}},
      {"mrpt::obs::CObservationWirelessPower", {radioPower, 0, 3}},
      {"mrpt::obs::CObservationComment", {comment, 0, 0}},
      {"mrpt::obs::CObservationImage", {image, 0, 4}}};
  return layouts;
}

}  // namespace lamp
