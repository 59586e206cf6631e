#include "lamp/refinement/Surfels.h"

#include <tbb/parallel_for.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <optional>
#include <tuple>

#include "ShuffledBits.h"
#include "lamp/core/SurfaceNormals.h"

namespace lamp {

namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Eigen::Vector3f;

constexpr int kNormalNeighbors = 10;
/** Of so many blocks one is held back. */
constexpr size_t kHeldBack = 8;
/** Fewer points than this say nothing of a plane. */
constexpr size_t kMinPoints = 8;
/** Largest variance across a plane, as a share of the smaller one along it. */
constexpr double kMaxUnevenness = 0.15;
/** Least cosine between a plane's normal and that of the points by themselves: down a corridor a
 * ring of a lidar draws an outline, and planes fitted to that look along the corridor. */
constexpr double kMinNormalAgreement = 0.7;

/** Cell and side of a surface: the side that the largest coordinate of the normal tells, so that
 * floor and wall, floor and ceiling, and the two sides of a wall come apart. */
uint64_t keyOf(const Vector3d& world_p, const Vector3d& world_normal, double cell_m) {
  constexpr int kBits = 20;
  uint64_t key = 0;
  for (int k = 0; k < 3; ++k) {
    const auto cell = static_cast<int64_t>(std::floor(world_p[k] / cell_m));
    key = (key << kBits) | (static_cast<uint64_t>(cell) & ((1u << kBits) - 1));
  }
  Eigen::Index axis;
  world_normal.cwiseAbs().maxCoeff(&axis);
  return (key << 3) | (static_cast<uint64_t>(axis) << 1) | (world_normal[axis] < 0 ? 1 : 0);
}

/** Whether the block of the scan's own frame that a point lies in is held back. */
bool isHeldBack(const Vector3f& node_p) {
  constexpr double kBlock_m = 1.0;
  uint64_t block = keyOf(node_p.cast<double>(), Vector3d::UnitZ(), kBlock_m);
  return shuffledBits(block) % kHeldBack == 0;
}

struct CellOfNode {
  CellPoints cell;
  uint32_t node;
};

/** The surfel that the points of several scans in one cell make up, if they do. */
std::optional<Surfel> surfelOf(const CellOfNode* begin, const CellOfNode* end,
                               const std::vector<Pose3>& world_T_node) {
  if (end - begin < 2) return std::nullopt;
  CellPoints all;
  for (const CellOfNode* of = begin; of != end; ++of) {
    all.points += of->cell.points;
    all.sum += of->cell.sum;
    all.squares += of->cell.squares;
    all.normals += of->cell.normals;
  }
  if (all.points < kMinPoints) return std::nullopt;
  const Vector3d mean = all.mean();
  const Matrix3d covariance = all.squares / all.points - mean * mean.transpose();
  const Eigen::SelfAdjointEigenSolver<Matrix3d> axes(covariance);
  if (!(axes.eigenvalues()[0] < kMaxUnevenness * axes.eigenvalues()[1])) return std::nullopt;
  Surfel surfel;
  surfel.key = begin->cell.key;
  surfel.world_normal = axes.eigenvectors().col(0);
  const double agreement = surfel.world_normal.dot(all.normals) / all.points;
  if (std::abs(agreement) < kMinNormalAgreement) return std::nullopt;
  if (agreement < 0) surfel.world_normal = -surfel.world_normal;
  for (const CellOfNode* of = begin; of != end; ++of)
    surfel.views.push_back(
        {of->node, of->cell.points, world_T_node[of->node].inverse() * of->cell.mean()});
  return surfel;
}

}  // namespace

SplitSurface splitSurface(const Scan& scan) {
  const KdTree tree(scan.points);
  const FittedPlanes planes = fitPlanes(scan.points, tree, kNormalNeighbors, false);
  SplitSurface split;
  for (size_t i = 0; i < scan.size(); ++i) {
    Vector3f normal = planes.normals[i];
    if (normal.isZero()) continue;
    const Vector3f to_lidar = scan.sensors[scan.sensor[i]].position.cast<float>() - scan.points[i];
    if (normal.dot(to_lidar) < 0) normal = -normal;
    ScanSurface& part = isHeldBack(scan.points[i]) ? split.held_back : split.used;
    part.points.push_back(scan.points[i]);
    part.normals.push_back(normal);
  }
  return split;
}

std::vector<CellPoints> cellsOf(const ScanSurface& surface, const Pose3& world_T_node,
                                double cell_m) {
  std::vector<std::pair<uint64_t, uint32_t>> order;
  for (uint32_t i = 0; i < surface.points.size(); ++i)
    order.emplace_back(keyOf(world_T_node * surface.points[i].cast<double>(),
                             world_T_node.linear() * surface.normals[i].cast<double>(), cell_m),
                       i);
  std::sort(order.begin(), order.end());
  std::vector<CellPoints> cells;
  for (const auto& [key, i] : order) {
    if (cells.empty() || cells.back().key != key) cells.emplace_back().key = key;
    CellPoints& cell = cells.back();
    const Vector3d p = world_T_node * surface.points[i].cast<double>();
    ++cell.points;
    cell.sum += p;
    cell.squares += p * p.transpose();
    cell.normals += world_T_node.linear() * surface.normals[i].cast<double>();
  }
  return cells;
}

std::vector<Surfel> findSurfels(const std::vector<SplitSurface>& surfaces,
                                const std::vector<Pose3>& world_T_node, double cell_m) {
  std::vector<std::vector<CellPoints>> of_nodes(surfaces.size());
  tbb::parallel_for(size_t{0}, surfaces.size(), [&](size_t i) {
    of_nodes[i] = cellsOf(surfaces[i].used, world_T_node[i], cell_m);
  });
  std::vector<CellOfNode> cells;
  for (uint32_t node = 0; node < of_nodes.size(); ++node) {
    for (const CellPoints& cell : of_nodes[node]) cells.push_back({cell, node});
    of_nodes[node] = {};
  }
  std::sort(cells.begin(), cells.end(), [](const CellOfNode& a, const CellOfNode& b) {
    return std::tie(a.cell.key, a.node) < std::tie(b.cell.key, b.node);
  });
  std::vector<Surfel> surfels;
  for (const CellOfNode *begin = cells.data(), *const last = begin + cells.size(), *end;
       begin != last; begin = end) {
    end = std::find_if(begin, last,
                       [&](const CellOfNode& of) { return of.cell.key != begin->cell.key; });
    if (auto surfel = surfelOf(begin, end, world_T_node)) surfels.push_back(std::move(*surfel));
  }
  return surfels;
}

}  // namespace lamp
