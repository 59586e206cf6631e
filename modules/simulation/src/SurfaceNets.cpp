#include "lamp/simulation/SurfaceNets.h"

#include <tbb/parallel_for.h>

#include <cmath>

namespace lamp::simulation {

namespace {

using Eigen::Vector3d;
using Eigen::Vector3i;

/** Cells along an edge of a block. Blocks overlap by one cell, so that each can close its seams. */
constexpr int kBlockCells = 16;
constexpr int kCells = kBlockCells + 1;
constexpr int kCorners = kCells + 1;
constexpr uint32_t kNone = UINT32_MAX;

size_t cornerIndex(int x, int y, int z) {
  return static_cast<size_t>((z * kCorners + y) * kCorners + x);
}
size_t cellIndex(int x, int y, int z) {
  return static_cast<size_t>((z * kCells + y) * kCells + x);
}

/** One block of the grid; `first` is its first cell, in cells of the whole grid. */
class Block {
 public:
  Block(const FreeSpace& space, double cell_m, const Vector3i& first)
      : space_(space), cell_m_(cell_m), first_(first) {}

  Mesh mesh() {
    const Eigen::AlignedBox3d box(position(Vector3i::Zero()),
                                  position(Vector3i::Constant(kCorners - 1)));
    parts_ = space_.partsIn(box);
    if (parts_.hollows.empty()) return {};
    const double reach = 0.5 * box.diagonal().norm() + space_.roughness();
    if (std::abs(space_.smooth(box.center(), parts_).distance_m) > reach) return {};
    sample();
    placeVertices();
    for (int z = 1; z < kCells; ++z)
      for (int y = 1; y < kCells; ++y)
        for (int x = 1; x < kCells; ++x) joinAround({x, y, z});
    return std::move(mesh_);
  }

 private:
  Vector3d position(const Vector3i& corner) const {
    return cell_m_ * (first_ + corner).cast<double>();
  }

  void sample() {
    distance_.resize(kCorners * kCorners * kCorners);
    hollow_.resize(distance_.size());
    for (int z = 0; z < kCorners; ++z)
      for (int y = 0; y < kCorners; ++y)
        for (int x = 0; x < kCorners; ++x) {
          const Vector3d p = position({x, y, z});
          const FreeSpace::Sample sample = space_.smooth(p, parts_);
          const size_t i = cornerIndex(x, y, z);
          hollow_[i] = static_cast<uint32_t>(sample.hollow);
          distance_[i] = static_cast<float>(space_.rough(p, sample));
        }
  }

  bool isFree(int x, int y, int z) const { return distance_[cornerIndex(x, y, z)] < 0; }

  /** A vertex for each cell with a wall in it: the mean of where its edges meet the wall. */
  void placeVertices() {
    vertex_.assign(kCells * kCells * kCells, kNone);
    for (int z = 0; z < kCells; ++z)
      for (int y = 0; y < kCells; ++y)
        for (int x = 0; x < kCells; ++x) {
          Vector3d sum = Vector3d::Zero();
          int crossings = 0;
          forEdges([&](const Vector3i& a, const Vector3i& b) {
            const double at_a = distance_[cornerIndex(x + a.x(), y + a.y(), z + a.z())];
            const double at_b = distance_[cornerIndex(x + b.x(), y + b.y(), z + b.z())];
            if ((at_a < 0) == (at_b < 0)) return;
            const double share = at_a / (at_a - at_b);
            sum += a.cast<double>() + share * (b - a).cast<double>();
            ++crossings;
          });
          if (crossings == 0) continue;
          vertex_[cellIndex(x, y, z)] = static_cast<uint32_t>(mesh_.vertices.size());
          const Vector3d cell = (first_ + Vector3i(x, y, z)).cast<double>();
          mesh_.vertices.push_back((cell_m_ * (cell + sum / crossings)).cast<float>());
        }
  }

  /** The twelve edges of a cell. */
  template <class Visit>
  static void forEdges(Visit visit) {
    for (int axis = 0; axis < 3; ++axis)
      for (int i = 0; i < 4; ++i) {
        Vector3i a = Vector3i::Zero();
        a[(axis + 1) % 3] = i & 1;
        a[(axis + 2) % 3] = i >> 1;
        Vector3i b = a;
        b[axis] = 1;
        visit(a, b);
      }
  }

  /** Two triangles for each of the three grid edges that start at a corner and cross a wall. */
  void joinAround(const Vector3i& corner) {
    for (int axis = 0; axis < 3; ++axis) {
      Vector3i next = corner;
      next[axis] += 1;
      const bool free = isFree(corner.x(), corner.y(), corner.z());
      if (free == isFree(next.x(), next.y(), next.z())) continue;
      Vector3i u = Vector3i::Zero(), v = Vector3i::Zero();
      u[(axis + 1) % 3] = 1;
      v[(axis + 2) % 3] = 1;
      std::array<uint32_t, 4> quad{};
      const Vector3i cells[4] = {corner - u - v, corner - v, corner, corner - u};
      for (int i = 0; i < 4; ++i)
        quad[static_cast<size_t>(i)] = vertex_[cellIndex(cells[i].x(), cells[i].y(), cells[i].z())];
      // The quad runs counter-clockwise when seen against the axis.
      if (free) std::swap(quad[1], quad[3]);
      const size_t hollow = hollow_[cornerIndex(corner.x(), corner.y(), corner.z())];
      addTriangle({quad[0], quad[1], quad[2]}, hollow);
      addTriangle({quad[0], quad[2], quad[3]}, hollow);
    }
  }

  void addTriangle(const std::array<uint32_t, 3>& triangle, size_t hollow) {
    mesh_.triangles.push_back(triangle);
    mesh_.materials.push_back(space_.hollows()[hollow].style.material);
  }

  const FreeSpace& space_;
  const double cell_m_;
  const Vector3i first_;
  FreeSpace::Parts parts_;
  std::vector<float> distance_;
  std::vector<uint32_t> hollow_;
  std::vector<uint32_t> vertex_;
  Mesh mesh_;
};

}  // namespace

Mesh wallMesh(const FreeSpace& space, double cell_m) {
  const Eigen::AlignedBox3d bounds = space.bounds();
  const double block_m = kBlockCells * cell_m;
  const Vector3i low = (bounds.min() / block_m).array().floor().cast<int>() - 1;
  const Vector3i high = (bounds.max() / block_m).array().floor().cast<int>() + 1;
  const Vector3i count = high - low + Vector3i::Ones();
  std::vector<Mesh> layers(static_cast<size_t>(count.x()));
  tbb::parallel_for(0, count.x(), [&](int x) {
    for (int y = 0; y < count.y(); ++y)
      for (int z = 0; z < count.z(); ++z)
        layers[static_cast<size_t>(x)].append(
            Block(space, cell_m, kBlockCells * (low + Vector3i(x, y, z))).mesh());
  });
  Mesh mesh;
  for (const Mesh& layer : layers) mesh.append(layer);
  return mesh;
}

}  // namespace lamp::simulation
