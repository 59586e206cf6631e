#include "lamp/scans/FreeSpace.h"

#include <algorithm>
#include <cmath>

#include "OctahedralMap.h"

namespace lamp {

namespace {

using Eigen::Vector3f;

/** The margin grows by this share of the range. */
constexpr float kMarginPerRange = 0.03f;

/** Whether a ray of this range says anything; not if it is not finite. */
bool isRange(float range) {
  constexpr float kShortest_m = 1e-3f;
  return range >= kShortest_m && std::isfinite(range);
}

}  // namespace

FreeSpace::FreeSpace(const Cloud& cloud) {
  using octahedral::kCells;
  for (const Vector3f& position : cloud.viewpoints)
    views_.push_back(
        {position, std::vector<float>(kCells, 0.0f), std::vector<float>(kCells, 0.0f)});
  for (size_t i = 0; i < cloud.size(); ++i) {
    View& view = views_[cloud.viewpoint[i]];
    const Vector3f ray = cloud.points[i] - view.position;
    const float range = ray.norm();
    if (!isRange(range)) continue;
    const size_t cell = octahedral::cellOf(ray);
    view.far[cell] = std::max(view.far[cell], range);
    for (const size_t neighbor : octahedral::neighborhood(cell)) {
      float& near = view.near[neighbor];
      near = near == 0.0f ? range : std::min(near, range);
    }
  }
}

FreeSpace::Place FreeSpace::at(const Vector3f& point, float margin_m) const {
  Place place = Place::kUnknown;
  for (const View& view : views_) {
    const Vector3f ray = point - view.position;
    const float range = ray.norm();
    if (!isRange(range)) continue;
    const size_t cell = octahedral::cellOf(ray);
    if (view.far[cell] == 0.0f) continue;
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
