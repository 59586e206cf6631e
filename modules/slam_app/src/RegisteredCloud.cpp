#include "RegisteredCloud.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <stdexcept>

#include "lamp/core/CloudFile.h"
#include "lamp/scans/VoxelFilter.h"

namespace lamp {

namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;

/** Prepared scans have no points beyond it, and voxels need a bound. */
constexpr float kFarthest_m = 1e6f;
/** Offsets that lie nearer to each other can be one: floats are good to a millimetre over that. */
constexpr double kRegion_m = 1e4;
/** Rounding to more than this is more than what a registration is good for. */
constexpr double kMaxRounding_m = 0.1;
/** Half of a scan's points lie within these ranges, if they are metres. */
constexpr double kMinMedianRange_m = 0.2, kMaxMedianRange_m = 1000;
/** How many times as large as the other a cloud may be before their units are doubted. */
constexpr double kMaxSizeRatio = 20;

template <class... Values>
std::string format(const char* pattern, Values... values) {
  char text[400];
  std::snprintf(text, sizeof text, pattern, values...);
  return text;
}

/** A file's points, and where the sensor may have stood. */
struct Loaded {
  std::string path;
  CloudPoints cloud;
  size_t read = 0;
  Vector3f viewpoint = Vector3f::Zero();
  double median_range_m = 0;
};

/** Where the file does not tell: in their midst. */
Vector3f middleOf(const std::vector<Vector3f>& points) {
  Vector3d sum = Vector3d::Zero();
  for (const Vector3f& p : points) sum += p.cast<double>();
  return (sum / static_cast<double>(points.size())).cast<float>();
}

double medianRange(const std::vector<Vector3f>& points, const Vector3f& viewpoint) {
  std::vector<float> ranges;
  for (const Vector3f& p : points) ranges.push_back((p - viewpoint).norm());
  const auto middle = ranges.begin() + static_cast<std::ptrdiff_t>(ranges.size() / 2);
  std::nth_element(ranges.begin(), middle, ranges.end());
  return *middle;
}

/** \throws std::runtime_error if no registration could make sense of the points. */
void check(const Loaded& loaded) {
  const auto fail = [&](const std::string& what) {
    throw std::runtime_error("'" + loaded.path + "' " + what);
  };
  if (loaded.cloud.rounded_to_m > kMaxRounding_m)
    fail(
        format("has coordinates near %.0f %.0f %.0f m that were floats, which rounds them to %g m: "
               "export it with 64-bit coordinates (double), or relative to a point near it",
               loaded.cloud.offset.x(), loaded.cloud.offset.y(), loaded.cloud.offset.z(),
               loaded.cloud.rounded_to_m));
  const char* const units = "coordinates must be in metres";
  if (loaded.median_range_m > kMaxMedianRange_m)
    fail(
        format("has half of its points farther than %.0f m from the sensor, which no lidar sees: "
               "%s, are these millimetres?",
               loaded.median_range_m, units));
  if (loaded.median_range_m < kMinMedianRange_m)
    fail(
        format("has half of its points nearer than %.3f m to the sensor: %s, are these kilometres, "
               "or a normalised model?",
               loaded.median_range_m, units));
}

Loaded load(const std::string& path) {
  Loaded loaded;
  loaded.path = path;
  loaded.cloud = readCloudPoints(path);
  CloudPoints& cloud = loaded.cloud;
  loaded.read = cloud.points.size() + cloud.not_finite + cloud.no_return;
  const auto is_far = [](const Vector3f& p) { return p.norm() > kFarthest_m; };
  cloud.points.erase(std::remove_if(cloud.points.begin(), cloud.points.end(), is_far),
                     cloud.points.end());
  if (cloud.points.empty())
    throw std::runtime_error("'" + path + "' holds no point within 1000 km of its origin");
  loaded.viewpoint =
      cloud.viewpoint ? Vector3f(cloud.viewpoint->cast<float>()) : middleOf(cloud.points);
  loaded.median_range_m = medianRange(cloud.points, loaded.viewpoint);
  check(loaded);
  return loaded;
}

/** Share of the points that lie far behind another one as seen from the sensor: many in a map,
 * which was seen from many places. */
double shareHidden(const Loaded& loaded) {
  constexpr size_t kPoints = 30000;
  constexpr float kCell = 0.035f, kBehind = 1.5f, kBehind_m = 1.0f;
  std::map<std::array<int, 3>, float> nearest;
  const auto cellOf = [&](const Vector3f& ray) {
    const Vector3f direction = ray.normalized() / kCell;
    return std::array<int, 3>{static_cast<int>(std::floor(direction.x())),
                              static_cast<int>(std::floor(direction.y())),
                              static_cast<int>(std::floor(direction.z()))};
  };
  const std::vector<Vector3f>& points = loaded.cloud.points;
  const size_t stride = std::max<size_t>(1, points.size() / kPoints);
  for (size_t i = 0; i < points.size(); i += stride) {
    const Vector3f ray = points[i] - loaded.viewpoint;
    float& range = nearest.emplace(cellOf(ray), ray.norm()).first->second;
    range = std::min(range, ray.norm());
  }
  size_t hidden = 0, count = 0;
  for (size_t i = 0; i < points.size(); i += stride, ++count) {
    const Vector3f ray = points[i] - loaded.viewpoint;
    hidden += ray.norm() > kBehind * nearest[cellOf(ray)] + kBehind_m;
  }
  return static_cast<double>(hidden) / static_cast<double>(count);
}

std::vector<std::string> notesOn(const Loaded& loaded, const Loaded& other) {
  constexpr double kManyHidden = 0.4;
  std::vector<std::string> notes;
  if (loaded.cloud.rounded_to_m > 0)
    notes.push_back(
        format("its coordinates had been rounded to %.3f m as floats", loaded.cloud.rounded_to_m));
  if (!loaded.cloud.viewpoint)
    notes.push_back("it does not say where the sensor stood: its middle is taken");
  if (shareHidden(loaded) > kManyHidden)
    notes.push_back(
        "it was not seen from one place: a map of several scans has no free space and no sides of "
        "walls; cut out what can be seen from one place in it, with that place as VIEWPOINT");
  if (loaded.median_range_m > kMaxSizeRatio * other.median_range_m)
    notes.push_back(format("it is %.0f times as large as '%s': are both in metres?",
                           loaded.median_range_m / other.median_range_m, other.path.c_str()));
  return notes;
}

/** Moves the source to the target's offset, if they lie in one region. */
void shareOffset(Loaded& source, const Loaded& target) {
  const Vector3d shift = source.cloud.offset - target.cloud.offset;
  if (shift.isZero() || shift.norm() > kRegion_m || target.cloud.offset.isZero() ||
      source.cloud.offset.isZero())
    return;
  for (Vector3f& p : source.cloud.points) p += shift.cast<float>();
  source.viewpoint += shift.cast<float>();
  source.cloud.offset = target.cloud.offset;
}

RegisteredCloud registeredCloud(Loaded loaded, std::vector<std::string> notes,
                                const FrontEndOptions& options) {
  RegisteredCloud result;
  result.path = loaded.path;
  result.read = loaded.read;
  result.offset = loaded.cloud.offset;
  result.notes = std::move(notes);
  result.left_out = loaded.read - loaded.cloud.points.size();
  Scan scan;
  scan.points = std::move(loaded.cloud.points);
  scan.sensors = {{"lidar", loaded.viewpoint.cast<double>()}};
  scan.sensor.assign(scan.size(), 0);
  if (!options.keyed && scan.size() > static_cast<size_t>(options.voxel.target_points)) {
    AdaptiveVoxelFilter filter(options.voxel);
    scan = filter.filter(scan);
    result.leaf_m = filter.leaf();
  }
  result.scan = std::make_shared<const Scan>(std::move(scan));
  return result;
}

}  // namespace

std::pair<RegisteredCloud, RegisteredCloud> loadClouds(const std::string& source_path,
                                                       const std::string& target_path,
                                                       const FrontEndOptions& options) {
  Loaded source = load(source_path), target = load(target_path);
  std::vector<std::string> of_source = notesOn(source, target), of_target = notesOn(target, source);
  shareOffset(source, target);
  return {registeredCloud(std::move(source), std::move(of_source), options),
          registeredCloud(std::move(target), std::move(of_target), options)};
}

}  // namespace lamp
