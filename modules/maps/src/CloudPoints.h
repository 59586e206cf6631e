#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "lamp/maps/MapExporter.h"

namespace lamp {

/** A point of a map's cloud, and where it comes from. */
struct CloudPoint {
  Eigen::Vector3f position;  ///< in the frame of the map, metres
  uint32_t key_node = 0;     ///< place in the map
  uint32_t index = 0;        ///< in its keyed scan
};

/** Where the sensor was that saw a point; in the frame of the map, metres. */
Eigen::Vector3d sensorOf(const CloudPoint& point, const ComponentMap& map);

/** NaN if its scan has none. */
float intensityOf(const CloudPoint& point, const ComponentMap& map);

/** Keeps of each voxel the point nearest to the mean of those in it, the first of equals. The rest
 * stay in their order. \throws std::runtime_error if a point lies too far from the origin. */
void thinToMeans(std::vector<CloudPoint>& points, double voxel_m);

/** Normals of the surface at each point, unit length, towards the sensor that saw it; zero where
 * the points around show none. Points at one height are of a level 2D laser. */
std::vector<Eigen::Vector3f> normalsOf(const std::vector<CloudPoint>& points,
                                       const ComponentMap& map);

}  // namespace lamp
