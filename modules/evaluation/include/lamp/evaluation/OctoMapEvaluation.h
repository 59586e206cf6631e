#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lamp/core/Geometry.h"
#include "lamp/evaluation/TrueSurface.h"

namespace lamp::evaluation {

/** How many of a set of places an octree calls occupied, free and unknown. */
struct OctoMapCounts {
  size_t occupied = 0, free = 0, unknown = 0;

  size_t total() const { return occupied + free + unknown; }
};

/** An octree against the truth. */
struct OctoMapEvaluation {
  double resolution_m = 0;
  double free_resolution_m = 0;  ///< of the voxels in which free space was found
  OctoMapCounts surface;         ///< voxels of the octree with a seen sample
  OctoMapCounts free_space;      ///< truly free voxels (see FreeSpace.h)
  OctoMapCounts driven_floor;    ///< samples of the floor that the robots drove on
  OctoMapCounts moving;          ///< voxels in which something was that moves
  std::string no_free_space;     ///< why free space was not judged; empty if it was
};

/** \param tree path of a `.bt` or `.ot` file. \param surface_T_world the alignment.
 *  \param positions of the robots' bases, true, in the surface's frame.
 *  \param moving points of what moves, where the run puts them, in the surface's frame.
 *  \throws std::runtime_error naming the file if it is no octree. */
OctoMapEvaluation evaluateOctoMap(const std::string& tree, const Pose3& surface_T_world,
                                  const SurfaceSamples& surface,
                                  const std::vector<Eigen::Vector3f>& positions,
                                  const std::vector<Eigen::Vector3f>& moving);

}  // namespace lamp::evaluation
