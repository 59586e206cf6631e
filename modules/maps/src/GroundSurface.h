#pragma once

#include <Eigen/Core>
#include <vector>

#include "Storeys.h"
#include "lamp/maps/MapExporter.h"

namespace lamp {

/** The ground of one cell; what cannot be told is NaN. */
struct GroundPoint {
  Eigen::Vector3d position;  ///< the cell's middle at the height of the ground, frame of the map
  double step_m;             ///< greatest difference in height to a neighbour, beyond the slope
  double slope_deg;          ///< of the plane through the ground within a robot's body
  double clearance_m;        ///< from the ground to what is above it
  double cost;               ///< 0 easy ... 1 no robot gets there
};

/** The ground of each storey where it was seen, in the order of its cells. Heights are those of the
 * points that fell into the ground's highest voxel or the one below. */
std::vector<std::vector<GroundPoint>> groundOf(const std::vector<Storey>& storeys,
                                               const ComponentMap& map,
                                               const OccupancyOptions& options);

}  // namespace lamp
