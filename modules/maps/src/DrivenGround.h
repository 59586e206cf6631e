#pragma once

#include <optional>
#include <unordered_map>
#include <vector>

#include "VoxelBlock.h"
#include "lamp/maps/MapExporter.h"

namespace lamp {

/** The size of a robot, metres. */
struct RobotBody {
  double radius_m = 0.5;
  double height_m = 0.8;  ///< above the ground
};

/** What a robot's way says of the voxels: it drove on solid ground, and nothing was where it was.
 */
struct DrivenGround {
  VoxelSetBlocks ground;   ///< solid: occupied
  VoxelSetBlocks entered;  ///< by the robot's body
  /** When a robot's middle, half as wide as its body, was last in a voxel; stamps by voxelKey(). */
  std::unordered_map<uint64_t, double> crossed;
  /** The highest voxel of the ground under the body, in the order of the ways; some more than once.
   */
  std::vector<VoxelIndex> floor;
};

/** How high a robot's base is above the ground: the median over its way of the height above the
 * highest occupied voxel below it. \return none if there is never one. */
std::optional<double> heightAboveGround(const MapTrack& track, const VoxelSetBlocks& occupied,
                                        double resolution_m);

/** The way of all robots. The ground under a robot's body, as steep as the robot stood, follows the
 * occupied voxels where there are any near. */
DrivenGround drivenGround(const std::vector<MapTrack>& tracks, const VoxelSetBlocks& occupied,
                          const RobotBody& body, double resolution_m);

}  // namespace lamp
