#include "PointColors.h"

#include <algorithm>
#include <cmath>

#include "MapPoints.h"
#include "lamp/core/Colormap.h"

namespace lamp {

namespace {

double brightnessOf(const CloudPoint& point, const ComponentMap& map) {
  return intensityOf(point, map);
}

double heightOf(const CloudPoint& point, const ComponentMap&) {
  return point.position.z();
}

double timeOf(const CloudPoint& point, const ComponentMap& map) {
  return map.key_nodes[point.key_node].stamp;
}

/** The value that a share of the values is below. */
double quantile(std::vector<double>& values, double share) {
  const auto at =
      values.begin() + static_cast<ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

}  // namespace

PointColors::PointColors(const ComponentMap& map, const std::string& property) : map_(map) {
  if (property == "robot") return;
  value_ = property == "intensity" ? brightnessOf : property == "height" ? heightOf : timeOf;
  // Of every n-th point, since all have to be kept at once; without the outermost.
  constexpr size_t kStride = 17;
  constexpr double kOutermost = 0.01;
  std::vector<double> values;
  size_t count = 0;
  forEachPoint(map, [&](const MapKeyNode& key_node, size_t i, const Eigen::Vector3d& position) {
    if (count++ % kStride != 0) return;
    const auto place = static_cast<uint32_t>(&key_node - map.key_nodes.data());
    const double value = value_({position.cast<float>(), place, static_cast<uint32_t>(i)}, map);
    if (std::isfinite(value)) values.push_back(value);
  });
  if (values.empty()) return;
  low_ = quantile(values, kOutermost);
  high_ = quantile(values, 1 - kOutermost);
}

Color PointColors::of(const CloudPoint& point) const {
  if (!value_) return robotColor(map_.key_nodes[point.key_node].id.robot);
  const double value = value_(point, map_);
  if (!std::isfinite(value)) return {128, 128, 128};
  const auto color = viridis(high_ > low_ ? (value - low_) / (high_ - low_) : 0.5);
  return {color[0], color[1], color[2]};
}

}  // namespace lamp
