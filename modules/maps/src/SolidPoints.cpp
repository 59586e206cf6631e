#include "SolidPoints.h"

namespace lamp {

SolidPoints::SolidPoints(const VoxelStates& states, const OccupancyOptions& occupancy)
    : occupancy_(occupancy), voxels_(states) {}

bool SolidPoints::isSolid(const CloudPoint& point, const ComponentMap& map) const {
  const MapKeyNode& key_node = map.key_nodes[point.key_node];
  // As exactly as the rays were cast: points may lie on the face of a voxel.
  const Eigen::Vector3d place = key_node.world_T_base *
                                key_node.scan->points[point.index].cast<double>() /
                                occupancy_.resolution_m;
  if (!(place.cwiseAbs().maxCoeff() < kGridReach)) return true;
  const VoxelState state = voxels_.at(voxelAt(place));
  const double range = (place * occupancy_.resolution_m - sensorOf(point, map)).norm();
  return range > occupancy_.max_range_m ? state >= 0 : state > 0;
}

}  // namespace lamp
