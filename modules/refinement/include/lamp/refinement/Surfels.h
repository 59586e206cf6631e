#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "lamp/core/Geometry.h"
#include "lamp/core/KeyedScan.h"

namespace lamp {

/** Points of one keyed scan that lie on a surface, in the frame of its key node, metres. */
struct ScanSurface {
  std::vector<Eigen::Vector3f> points;
  std::vector<Eigen::Vector3f> normals;  ///< unit length, towards the lidar that saw the point
};

/** A scan's surface in two parts: what poses are adjusted by, and what is held back to judge the
 * outcome by: an eighth, in blocks of about a metre, since points beside one another tell the same.
 */
struct SplitSurface {
  ScanSurface used, held_back;
};
SplitSurface splitSurface(const Scan& scan);

/** What one key node has seen of a surfel: the mean of its points there. */
struct SurfelView {
  uint32_t node = 0;  ///< place among the surfaces
  uint32_t points = 0;
  Eigen::Vector3d node_p_mean = Eigen::Vector3d::Zero();
};

/** A piece of surface that several key nodes of any robots have seen, and the plane that fits the
 * points of all of them. */
struct Surfel {
  uint64_t key = 0;                                         ///< CellPoints::key
  Eigen::Vector3d world_normal = Eigen::Vector3d::UnitZ();  ///< towards those who saw it
  std::vector<SurfelView> views;                            ///< in the order of the surfaces
};

/** Surfels, in the order of their keys, in the cells of a grid in the world, those of two sides of
 * a wall, of floor and wall, or of floor and ceiling apart. Cells that no plane fits have none, and
 * neither have those that a single key node sees: there is nothing to be learnt from them. \param
 * surfaces of which the used parts count. \param world_T_node one pose for each. \param cell_m edge
 * of a cell. */
std::vector<Surfel> findSurfels(const std::vector<SplitSurface>& surfaces,
                                const std::vector<Pose3>& world_T_node, double cell_m);

/** The points of one scan on one side of a surface in one cell. */
struct CellPoints {
  uint64_t key = 0;  ///< of cell and side
  uint32_t points = 0;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();      ///< of the points in the world
  Eigen::Vector3d normals = Eigen::Vector3d::Zero();  ///< sum
  Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();  ///< sum of p pᵀ

  Eigen::Vector3d mean() const { return sum / points; }
};
/** In the order of their keys. */
std::vector<CellPoints> cellsOf(const ScanSurface& surface, const Pose3& world_T_node,
                                double cell_m);

}  // namespace lamp
