#include "lamp/scans/VoxelFilter.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "GridCell.h"
#include "lamp/scans/Cloud.h"
#include "lamp/scans/LonePoints.h"

namespace lamp {

namespace {

/** Points of different sensors are not mixed. */
struct SensorCell {
  GridCell cell;
  uint8_t sensor;
  bool operator==(const SensorCell& o) const { return cell == o.cell && sensor == o.sensor; }
};

struct SensorCellHash {
  size_t operator()(const SensorCell& c) const {
    return GridCellHash()(c.cell) ^ size_t { c.sensor } << 48;
  }
};

struct Sum {
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  double intensity = 0;
  double time = 0;
  int count = 0;
  uint8_t sensor = 0;
};

}  // namespace

Scan voxelFilter(const Scan& scan, double leaf_m) {
  std::unordered_map<SensorCell, size_t, SensorCellHash> place;
  place.reserve(scan.size());
  std::vector<Sum> sums;
  for (size_t i = 0; i < scan.size(); ++i) {
    if (!isUsable(scan.points[i])) continue;
    const SensorCell cell{cellOf(scan.points[i], leaf_m), scan.sensor[i]};
    const auto [found, is_new] = place.emplace(cell, sums.size());
    if (is_new) sums.push_back({});
    Sum& sum = sums[found->second];
    sum.point += scan.points[i].cast<double>();
    if (scan.hasIntensity()) sum.intensity += scan.intensity[i];
    if (scan.hasTimes()) sum.time += scan.time[i];
    ++sum.count;
    sum.sensor = scan.sensor[i];
  }

  Scan result;
  result.sensors = scan.sensors;
  for (const Sum& sum : sums) {
    result.points.push_back((sum.point / sum.count).cast<float>());
    if (scan.hasIntensity())
      result.intensity.push_back(static_cast<float>(sum.intensity / sum.count));
    if (scan.hasTimes()) result.time.push_back(static_cast<float>(sum.time / sum.count));
    result.sensor.push_back(sum.sensor);
  }
  return result;
}

void AdaptiveVoxelOptions::visit(OptionVisitor& v) {
  v("target_points", target_points, "",
    "number of points the adaptive voxel filter aims for; more points cost time, fewer cost "
    "accuracy",
    {1});
  v("initial_leaf_m", initial_leaf_m, "m", "leaf size for the first scan", kPositive);
  v("min_leaf_m", min_leaf_m, "m", "smallest leaf size", kPositive);
  v("max_leaf_m", max_leaf_m, "m", "largest leaf size", kPositive);
  v("max_passes", max_passes, "",
    "maximum number of filter passes over one scan to reach the target", {1});
}

AdaptiveVoxelFilter::AdaptiveVoxelFilter(const AdaptiveVoxelOptions& options)
    : options_(options),
      leaf_(std::clamp(options.initial_leaf_m, options.min_leaf_m,
                       std::max(options.min_leaf_m, options.max_leaf_m))) {}

Scan AdaptiveVoxelFilter::filter(const Scan& scan) {
  constexpr double kCloseEnough = 0.07;
  constexpr double kLeastRest = 0.8;  // else the scan is thin, and its points are no outliers
  Scan filtered = voxelFilter(scan, leaf_);
  for (int pass = 1; pass < options_.max_passes && !filtered.points.empty(); ++pass) {
    const double next = corrected(filtered.size());
    if (std::abs(next / leaf_ - 1.0) < 0.5 * kCloseEnough) break;
    leaf_ = next;
    filtered = voxelFilter(scan, leaf_);
  }
  Scan rest = withoutLonePoints(filtered, options_.max_leaf_m);
  const bool thin =
      static_cast<double>(rest.size()) < kLeastRest * static_cast<double>(filtered.size());
  return thin ? filtered : rest;
}

double AdaptiveVoxelFilter::corrected(size_t points) const {
  // Surfaces fill a grid with about 1/leaf² cells, hence the root.
  const double ratio = std::sqrt(static_cast<double>(points) / options_.target_points);
  return std::clamp(leaf_ * ratio, options_.min_leaf_m,
                    std::max(options_.min_leaf_m, options_.max_leaf_m));
}

}  // namespace lamp
