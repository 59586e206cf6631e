#include "TopView.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <vector>

#include "MapPoints.h"

namespace lamp {

namespace {

constexpr double kOutermostShare = 0.001;
constexpr size_t kSamples = 1000000;
constexpr double kMarginShare = 0.02;
constexpr double kLeastMargin_m = 0.5;

using Box = Eigen::AlignedBox2d;

size_t pointCount(const ComponentMap& map) {
  size_t count = 0;
  for (const MapKeyNode& key_node : map.key_nodes)
    if (key_node.scan) count += key_node.scan->size();
  return count;
}

void trim(std::vector<float>& values, double& low, double& high) {
  const auto skip = static_cast<std::ptrdiff_t>(kOutermostShare * values.size());
  std::nth_element(values.begin(), values.begin() + skip, values.end());
  low = values[skip];
  std::nth_element(values.begin(), values.end() - 1 - skip, values.end());
  high = values[values.size() - 1 - skip];
}

Box boxOfPoints(const ComponentMap& map) {
  const size_t step = pointCount(map) / kSamples + 1;
  size_t k = 0;
  std::vector<float> xs, ys;
  forEachPoint(map, [&](const MapKeyNode&, size_t, const Eigen::Vector3d& p) {
    if (k++ % step != 0) return;
    xs.push_back(static_cast<float>(p.x()));
    ys.push_back(static_cast<float>(p.y()));
  });
  Box box;
  if (xs.empty()) return box;
  trim(xs, box.min().x(), box.max().x());
  trim(ys, box.min().y(), box.max().y());
  return box;
}

Box boxOf(const ComponentMap& map) {
  Box box = boxOfPoints(map);
  for (const MapTrack& track : map.tracks)
    for (const StampedPose& pose : track.poses)
      box.extend(pose.pose.translation().head<2>().eval());
  for (const MapKeyNode& key_node : map.key_nodes)
    box.extend(key_node.world_T_base.translation().head<2>().eval());
  for (const MapLoop& loop : map.loops)
    for (const Eigen::Vector3d& end : {loop.from, loop.to}) box.extend(end.head<2>().eval());
  if (box.isEmpty()) box.extend(Eigen::Vector2d::Zero());
  return box;
}

}  // namespace

TopView viewOf(const ComponentMap& map, int size_px, double finest_pixel_m) {
  return viewOf(boxOf(map), size_px, finest_pixel_m);
}

TopView viewOf(const Eigen::AlignedBox2d& box, int size_px, double finest_pixel_m) {
  const double margin = std::max(kLeastMargin_m, kMarginShare * box.sizes().maxCoeff());
  const Eigen::Vector2d sizes = box.sizes().array() + 2 * margin;

  TopView view;
  view.pixel_m = std::max(finest_pixel_m, sizes.maxCoeff() / size_px);
  view.top_left = {box.min().x() - margin, box.max().y() + margin};
  const auto pixels = [&](double length) {
    return std::clamp(static_cast<int>(std::lround(length / view.pixel_m)), 1, size_px);
  };
  view.width = pixels(sizes.x());
  view.height = pixels(sizes.y());
  return view;
}

}  // namespace lamp
