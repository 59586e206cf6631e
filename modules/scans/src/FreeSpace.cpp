#include "lamp/scans/FreeSpace.h"

#include <algorithm>
#include <cmath>

namespace lamp {

namespace {

using Eigen::Vector3f;

/** Cells along an edge of the unfolded octahedron: about 2 degrees each, which a keyed scan of some
 * thousand points fills with a point each. */
constexpr int kEdge = 96;
/** The margin grows by this share of the range. */
constexpr float kMarginPerRange = 0.03f;

int cellAlong(float value) {
  return std::clamp(static_cast<int>((value + 1.0f) * (0.5f * kEdge)), 0, kEdge - 1);
}

/** The cell of a direction: the octahedron's upper half is the square's inner diamond, its lower
 * half is folded out to the corners. */
int cellOf(const Vector3f& direction) {
  const float sum = direction.cwiseAbs().sum();
  float u = direction.x() / sum, v = direction.y() / sum;
  if (direction.z() < 0) {
    const float folded = (1.0f - std::abs(v)) * (u < 0 ? -1.0f : 1.0f);
    v = (1.0f - std::abs(u)) * (v < 0 ? -1.0f : 1.0f);
    u = folded;
  }
  return kEdge * cellAlong(v) + cellAlong(u);
}

/** Calls `use` for the cells around one, itself included. Across the square's border the image goes
 * on elsewhere: those neighbours are left out. */
template <class Use>
void forNeighbors(int cell, const Use& use) {
  const int x = cell % kEdge, y = cell / kEdge;
  for (int j = std::max(y - 1, 0); j <= std::min(y + 1, kEdge - 1); ++j)
    for (int i = std::max(x - 1, 0); i <= std::min(x + 1, kEdge - 1); ++i) use(kEdge * j + i);
}

}  // namespace

FreeSpace::FreeSpace(const Cloud& cloud) {
  constexpr size_t kCells = size_t{kEdge} * kEdge;
  for (const Vector3f& position : cloud.viewpoints)
    views_.push_back(
        {position, std::vector<float>(kCells, 0.0f), std::vector<float>(kCells, 0.0f)});
  for (size_t i = 0; i < cloud.size(); ++i) {
    View& view = views_[cloud.viewpoint[i]];
    const Vector3f ray = cloud.points[i] - view.position;
    const float range = ray.norm();
    if (range < 1e-3f) continue;
    const auto cell = static_cast<size_t>(cellOf(ray));
    view.far[cell] = std::max(view.far[cell], range);
    forNeighbors(static_cast<int>(cell), [&](int neighbor) {
      float& near = view.near[static_cast<size_t>(neighbor)];
      near = near == 0.0f ? range : std::min(near, range);
    });
  }
}

FreeSpace::Place FreeSpace::at(const Vector3f& point, float margin_m) const {
  Place place = Place::kUnknown;
  for (const View& view : views_) {
    const Vector3f ray = point - view.position;
    const auto cell = static_cast<size_t>(cellOf(ray));
    if (view.far[cell] == 0.0f) continue;
    const float range = ray.norm();
    const float margin = margin_m + kMarginPerRange * range;
    if (range < view.near[cell] - margin) return Place::kFree;
    if (range <= view.far[cell] + margin) place = Place::kSurface;
  }
  return place;
}

size_t FreeSpace::bytes() const {
  size_t sum = 0;
  for (const View& view : views_)
    sum += sizeof(View) + (view.near.size() + view.far.size()) * sizeof(float);
  return sum;
}

}  // namespace lamp
