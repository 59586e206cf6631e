#include "GroundSurface.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "MapPoints.h"

namespace lamp {

namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kDegree = M_PI / 180;

/** Heights of a storey's ground, cell by cell. */
class GroundHeights {
 public:
  GroundHeights(const Storey& storey, double resolution_m) : voxel_m_(resolution_m) {
    for (const StoreyCell& cell : storey.cells)
      if (cell.seen) heights_[columnKey(cell.ground.x(), cell.ground.y())].top = cell.ground.z();
  }

  /** Counts the point if it is of the ground. */
  void add(const Vector3d& point) {
    const VoxelIndex voxel = voxelAt(point / voxel_m_);
    const auto found = heights_.find(columnKey(voxel.x(), voxel.y()));
    if (found == heights_.end()) return;
    Height& height = found->second;
    if (voxel.z() != height.top && voxel.z() != height.top - 1) return;
    height.sum += point.z();
    ++height.points;
  }

  /** Metres; NaN where there is no ground or no point of it. */
  double at(int x, int y) const {
    const auto found = heights_.find(columnKey(x, y));
    return found == heights_.end() || found->second.points == 0
               ? kNan
               : found->second.sum / static_cast<double>(found->second.points);
  }

 private:
  struct Height {
    int top = 0;
    double sum = 0;
    size_t points = 0;
  };

  double voxel_m_;
  std::unordered_map<uint64_t, Height> heights_;
};

/** The plane through the ground around a cell, by least squares: its height at the cell, and how
 * it rises along x and y; NaN where there is too little ground. */
Vector3d planeAround(const GroundHeights& heights, const VoxelIndex& cell, double radius_m,
                     double voxel_m) {
  const int reach = std::max(1, static_cast<int>(radius_m / voxel_m));
  Matrix3d normal = Matrix3d::Zero();
  Vector3d right = Vector3d::Zero();
  for (int dy = -reach; dy <= reach; ++dy)
    for (int dx = -reach; dx <= reach; ++dx) {
      const double height = heights.at(cell.x() + dx, cell.y() + dy);
      if (std::isnan(height)) continue;
      const Vector3d row(1, dx * voxel_m, dy * voxel_m);
      normal += row * row.transpose();
      right += height * row;
    }
  const Eigen::FullPivLU<Matrix3d> solver(normal);
  return solver.rank() == 3 ? Vector3d(solver.solve(right)) : Vector3d::Constant(kNan);
}

/** Greatest difference in height to a neighbour, less that of the plane; NaN without a neighbour.
 */
double stepAt(const GroundHeights& heights, const VoxelIndex& cell, const Vector3d& plane,
              double voxel_m) {
  const double here = heights.at(cell.x(), cell.y());
  double step = kNan;
  for (int dy = -1; dy <= 1; ++dy)
    for (int dx = -1; dx <= 1; ++dx) {
      const double rise = voxel_m * (plane.y() * dx + plane.z() * dy);
      const double beyond = std::abs(heights.at(cell.x() + dx, cell.y() + dy) - here - rise);
      if (dx != 0 || dy != 0) step = std::fmax(step, beyond);  // fmax passes NaN over
    }
  return step;
}

GroundPoint pointOf(const StoreyCell& cell, const GroundHeights& heights,
                    const OccupancyOptions& options) {
  const double voxel_m = options.resolution_m;
  const VoxelIndex& ground = cell.ground;
  const Vector3d plane = planeAround(heights, ground, options.body_radius_m, voxel_m);
  const double measured = heights.at(ground.x(), ground.y());
  const double height = !std::isnan(measured)    ? measured
                        : !std::isnan(plane.x()) ? plane.x()
                                                 : (ground.z() + 0.5) * voxel_m;
  GroundPoint point;
  point.position = {(ground.x() + 0.5) * voxel_m, (ground.y() + 0.5) * voxel_m, height};
  point.slope_deg = std::atan(plane.tail<2>().norm()) / kDegree;
  point.step_m = stepAt(heights, ground, plane, voxel_m);
  point.clearance_m =
      cell.clearance < kMostClearance ? (ground.z() + 1 + cell.clearance) * voxel_m - height : kNan;
  const bool too_low = cell.state == CellState::kOccupied;
  point.cost = too_low ? 1.0
                       : std::min(1.0, std::max(point.step_m / options.max_step_m,
                                                point.slope_deg / options.max_slope_deg));
  if (!too_low && (std::isnan(point.step_m) || std::isnan(point.slope_deg))) point.cost = kNan;
  return point;
}

}  // namespace

std::vector<std::vector<GroundPoint>> groundOf(const std::vector<Storey>& storeys,
                                               const ComponentMap& map,
                                               const OccupancyOptions& options) {
  std::vector<GroundHeights> heights;
  for (const Storey& storey : storeys) heights.emplace_back(storey, options.resolution_m);
  forEachPoint(map, [&](const MapKeyNode& key_node, size_t i, const Vector3d& point) {
    if (key_node.scan->points[i].cast<double>().norm() > options.max_range_m) return;
    for (GroundHeights& storey : heights) storey.add(point);
  });

  std::vector<std::vector<GroundPoint>> ground(storeys.size());
  for (size_t k = 0; k < storeys.size(); ++k)
    for (const StoreyCell& cell : storeys[k].cells)
      if (cell.seen) ground[k].push_back(pointOf(cell, heights[k], options));
  return ground;
}

}  // namespace lamp
