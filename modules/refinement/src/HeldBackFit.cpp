#include "HeldBackFit.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace lamp {

namespace {

using Eigen::Vector3d;

/** Means of fewer points say more of how rough a surface is than of where it is. */
constexpr uint32_t kMinPoints = 3;
/** A distance from which on a mean counts little more: it may lie on something else. */
constexpr double kKernel_m = 0.2;

/** The points of a surfel that others than `node` have seen lie on a plane through this. */
Vector3d meanOfOthers(const Surfel& surfel, uint32_t node, const std::vector<Pose3>& world_T_node,
                      uint32_t& points) {
  Vector3d sum = Vector3d::Zero();
  points = 0;
  for (const SurfelView& view : surfel.views) {
    if (view.node == node) continue;
    sum += view.points * (world_T_node[view.node] * view.node_p_mean);
    points += view.points;
  }
  return sum / std::max(points, 1u);
}

}  // namespace

HeldBackFit heldBackFit(const std::vector<SplitSurface>& surfaces,
                        const std::vector<Surfel>& surfels, const std::vector<Pose3>& world_T_node,
                        double cell_m) {
  struct Sum {
    size_t patches = 0;
    double squares = 0;
  };
  std::vector<Sum> sums(surfaces.size());
  tbb::parallel_for(size_t{0}, surfaces.size(), [&](size_t i) {
    const auto node = static_cast<uint32_t>(i);
    for (const CellPoints& cell : cellsOf(surfaces[i].held_back, world_T_node[i], cell_m)) {
      const auto surfel =
          std::lower_bound(surfels.begin(), surfels.end(), cell.key,
                           [](const Surfel& s, uint64_t key) { return s.key < key; });
      if (cell.points < kMinPoints || surfel == surfels.end() || surfel->key != cell.key) continue;
      uint32_t points;
      const Vector3d others = meanOfOthers(*surfel, node, world_T_node, points);
      if (points < kMinPoints) continue;
      const double distance = surfel->world_normal.dot(cell.mean() - others);
      const double squared = distance * distance, kernel = kKernel_m * kKernel_m;
      sums[i].squares += squared * kernel / (squared + kernel);
      ++sums[i].patches;
    }
  });
  HeldBackFit fit;
  double squares = 0;
  for (const Sum& sum : sums) {
    fit.patches += sum.patches;
    squares += sum.squares;
  }
  if (fit.patches > 0) fit.rms_m = std::sqrt(squares / static_cast<double>(fit.patches));
  return fit;
}

}  // namespace lamp
