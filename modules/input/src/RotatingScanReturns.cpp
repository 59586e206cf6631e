#include <cmath>
#include <stdexcept>

#include "SensorReturns.h"
#include "VelodyneModel.h"

namespace lamp {
namespace {

using mrpt::obs::CObservationRotatingScan;

/** Direction and time of each pixel of the range image. */
struct Beams {
  std::vector<double> elevation;  ///< by row, radians
  double first_azimuth = 0;       ///< radians, counterclockwise
  double azimuth_step = 0;        ///< radians per column
  double time_step = 0;           ///< seconds per column; 0 where the recording has no times
  double row_step = 0;            ///< columns that the lidar turns on from row to row

  double azimuth(int row, int col) const {
    return first_azimuth + azimuth_step * (col + row_step * row);
  }
  double time(int row, int col) const { return time_step * (col + row_step * row); }
};

bool isConvertedVelodyne(const CObservationRotatingScan& scan) {
  return scan.lidarModel == "VLP-16" || scan.lidarModel == "HDL-32E";
}

/** CObservationRotatingScan::fromVelodyne() does not keep to its own class's description: azimuths
 * run clockwise, as in the packets, and `columnCount` counts single returns although a column is
 * one firing of all lasers. */
Beams convertedVelodyneBeams(const CObservationRotatingScan& scan) {
  const VelodyneModel model = velodyneModel(scan.lidarModel);
  if (model.lasers.size() != scan.rowCount) {
    throw std::runtime_error("CObservationRotatingScan of a " + scan.lidarModel + " with " +
                             std::to_string(scan.rowCount) +
                             " rows: not what that lidar has; record it as a point cloud");
  }
  Beams beams;
  for (const VelodyneLaser& laser : model.lasers) beams.elevation.push_back(laser.elevation_rad);
  const double columns = static_cast<double>(scan.columnCount) / scan.rowCount;
  beams.first_azimuth = -scan.startAzimuth;
  beams.azimuth_step = -scan.azimuthSpan / columns;
  beams.time_step = scan.sweepDuration / columns;
  beams.row_step = model.laser_s / model.firing_s;
  return beams;
}

Beams beamsOf(const CObservationRotatingScan& scan) {
  if (isConvertedVelodyne(scan)) return convertedVelodyneBeams(scan);
  if (scan.rowCount > 1) {
    throw std::runtime_error("CObservationRotatingScan of the lidar model '" + scan.lidarModel +
                             "': the elevation of its " + std::to_string(scan.rowCount) +
                             " rows is not recorded; record it as CObservationPointCloud");
  }
  Beams beams;
  beams.elevation.assign(1, 0.0);
  beams.first_azimuth = scan.startAzimuth;
  if (scan.columnCount > 1) {
    beams.azimuth_step = scan.azimuthSpan / (scan.columnCount - 1);
    beams.time_step = scan.sweepDuration / (scan.columnCount - 1);
  }
  return beams;
}

}  // namespace

SensorReturns returnsOf(const CObservationRotatingScan& scan) {
  SensorReturns returns;
  returns.max_range_m = scan.maxRange;
  if (scan.rangeImage.empty()) return returns;
  const Beams beams = beamsOf(scan);
  const bool has_intensity = scan.intensityImage.rows() == scan.rangeImage.rows() &&
                             scan.intensityImage.cols() == scan.rangeImage.cols();
  for (int row = 0; row < scan.rangeImage.rows(); ++row) {
    const double elevation = beams.elevation.at(static_cast<size_t>(row));
    for (int col = 0; col < scan.rangeImage.cols(); ++col) {
      if (scan.rangeImage(row, col) == 0) continue;
      const double range = scan.rangeImage(row, col) * scan.rangeResolution;
      const double azimuth = beams.azimuth(row, col);
      const Eigen::Vector3d direction(std::cos(elevation) * std::cos(azimuth),
                                      std::cos(elevation) * std::sin(azimuth), std::sin(elevation));
      returns.points.push_back((range * direction).cast<float>());
      if (has_intensity) returns.intensity.push_back(scan.intensityImage(row, col) / 255.0f);
      if (beams.time_step != 0) returns.time.push_back(static_cast<float>(beams.time(row, col)));
    }
  }
  return returns;
}

}  // namespace lamp
