#include "SolidPoints.h"

namespace lamp {

SolidPoints::SolidPoints(const VoxelStates& states, const Grid& grid) : grid_(grid) {
  blocks_.reserve(states.size());
  for (const auto& [key, block] : states) blocks_[key] = &block;
}

VoxelState SolidPoints::stateAt(const VoxelIndex& voxel) const {
  const auto found = blocks_.find(blockOf(voxel));
  return found == blocks_.end() ? VoxelState{0} : (*found->second)[placeInBlock(voxel)];
}

bool SolidPoints::isSolid(const CloudPoint& point, const ComponentMap& map) const {
  const MapKeyNode& key_node = map.key_nodes[point.key_node];
  // As exactly as the rays were cast: points may lie on the face of a voxel.
  const Eigen::Vector3d place = key_node.world_T_base *
                                key_node.scan->points[point.index].cast<double>() /
                                grid_.resolution_m;
  if (!(place.cwiseAbs().maxCoeff() < kGridReach)) return true;
  const VoxelState state = stateAt(voxelAt(place));
  const double range = (place * grid_.resolution_m - sensorOf(point, map)).norm();
  return range > grid_.max_range_m ? state >= 0 : state > 0;
}

}  // namespace lamp
