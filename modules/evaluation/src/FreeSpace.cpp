#include "lamp/evaluation/FreeSpace.h"

#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace lamp::evaluation {

namespace {

using Eigen::Vector3f;
using Eigen::Vector3i;

constexpr double kMaxVoxels = 8e9;   ///< two bits each: 2 GB
constexpr double kNearGround = 0.4;  ///< metres; less than any robot is high

/** Voxels of a box, with one bit each for `surface` and for `reached`. */
class VoxelBox {
 public:
  VoxelBox(const Vector3f& min, const Vector3f& max, double voxel_m)
      : voxel_m_(voxel_m), first_((min.cast<double>() / voxel_m).array().floor().cast<int>()) {
    size_ = (max.cast<double>() / voxel_m).array().floor().cast<int>().matrix() - first_ +
            Vector3i::Ones();
    const double count = size_.cast<double>().prod();
    if (count > kMaxVoxels)
      throw std::runtime_error("the world has " + std::to_string(count / 1e9) +
                               " billion voxels, too many for this measure");
    surface_.resize(static_cast<size_t>(count));
    reached_.resize(static_cast<size_t>(count));
  }

  Vector3i cellOf(const Vector3f& p) const {
    return Vector3i((p.cast<double>() / voxel_m_).array().floor().cast<int>()) - first_;
  }
  Eigen::Vector3d center(const Vector3i& cell) const {
    return ((cell + first_).cast<double>().array() + 0.5) * voxel_m_;
  }
  bool contains(const Vector3i& cell) const {
    return (cell.array() >= 0).all() && (cell.array() < size_.array()).all();
  }
  const Vector3i& size() const { return size_; }

  void markSurface(const Vector3i& cell) { surface_[place(cell)] = true; }
  bool isSurface(const Vector3i& cell) const { return surface_[place(cell)]; }
  bool isReached(const Vector3i& cell) const { return reached_[place(cell)]; }
  /** \return whether the voxel is free and was not reached before. */
  bool reach(const Vector3i& cell) {
    if (!contains(cell) || isSurface(cell) || isReached(cell)) return false;
    reached_[place(cell)] = true;
    return true;
  }

 private:
  size_t place(const Vector3i& cell) const {
    return (static_cast<size_t>(cell.z()) * static_cast<size_t>(size_.y()) +
            static_cast<size_t>(cell.y())) *
               static_cast<size_t>(size_.x()) +
           static_cast<size_t>(cell.x());
  }

  double voxel_m_;
  Vector3i first_, size_;
  std::vector<bool> surface_, reached_;
};

VoxelBox boxOfSeen(const SurfaceSamples& surface, double voxel_m) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  Vector3f min = Vector3f::Constant(kInfinity), max = -min;
  for (size_t i = 0; i < surface.points.size(); ++i) {
    if (!surface.seen[i]) continue;
    min = min.cwiseMin(surface.points[i]);
    max = max.cwiseMax(surface.points[i]);
  }
  return VoxelBox(min, max, voxel_m);
}

/** The voxel of a robot's base. A base near the ground may lie within or below its samples, and
 * outside is not free: then the first voxel above them. */
Vector3i startOf(const Vector3f& position, const VoxelBox& box, double voxel_m) {
  const Vector3i base = box.cellOf(position);
  const int reach = static_cast<int>(std::ceil(kNearGround / voxel_m));
  for (int up = reach; up >= -reach; --up) {
    const Vector3i cell = base + Vector3i(0, 0, up);
    if (box.contains(cell) && box.isSurface(cell)) return cell + Vector3i(0, 0, 1);
  }
  return base;
}

void flood(std::vector<Vector3i> front, VoxelBox& box) {
  static const std::array<Vector3i, 6> kFaces = {Vector3i(1, 0, 0), Vector3i(-1, 0, 0),
                                                 Vector3i(0, 1, 0), Vector3i(0, -1, 0),
                                                 Vector3i(0, 0, 1), Vector3i(0, 0, -1)};
  while (!front.empty()) {
    const Vector3i cell = front.back();
    front.pop_back();
    for (const Vector3i& step : kFaces)
      if (box.reach(cell + step)) front.push_back(cell + step);
  }
}

bool touchesSurface(const Vector3i& cell, const VoxelBox& box) {
  for (int x = -1; x <= 1; ++x)
    for (int y = -1; y <= 1; ++y)
      for (int z = -1; z <= 1; ++z) {
        const Vector3i neighbor = cell + Vector3i(x, y, z);
        if (box.contains(neighbor) && box.isSurface(neighbor)) return true;
      }
  return false;
}

}  // namespace

void forEachFreeVoxel(const SurfaceSamples& surface, const std::vector<Vector3f>& positions,
                      double voxel_m, const std::function<void(const Eigen::Vector3d&)>& take) {
  VoxelBox box = boxOfSeen(surface, voxel_m);
  for (const Vector3f& p : surface.points)
    if (box.contains(box.cellOf(p))) box.markSurface(box.cellOf(p));
  std::vector<Vector3i> front;
  for (const Vector3f& p : positions)
    if (const Vector3i start = startOf(p, box, voxel_m); box.reach(start)) front.push_back(start);
  flood(std::move(front), box);
  Vector3i cell;
  for (cell.z() = 0; cell.z() < box.size().z(); ++cell.z())
    for (cell.y() = 0; cell.y() < box.size().y(); ++cell.y())
      for (cell.x() = 0; cell.x() < box.size().x(); ++cell.x())
        if (box.isReached(cell) && !touchesSurface(cell, box)) take(box.center(cell));
}

}  // namespace lamp::evaluation
