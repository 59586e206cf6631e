#pragma once

#include <Eigen/Core>
#include <cstdint>

namespace lamp {

/** Names a voxel of a regular grid through the origin, in 63 bits. \param voxel_m its edge, metres,
 * positive. \throws std::runtime_error if the point lies more than 2^20 voxels from the origin. */
uint64_t voxelKey(const Eigen::Vector3d& point, double voxel_m);

}  // namespace lamp
