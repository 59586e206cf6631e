#include "RegisteredCloud.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <stdexcept>

#include "MapViews.h"
#include "lamp/core/CloudFile.h"
#include "lamp/scans/LonePoints.h"
#include "lamp/scans/VoxelFilter.h"

namespace lamp {

namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;

/** Prepared scans leave out points beyond it, since voxel grids need a bound. */
constexpr float kFarthest_m = 1e6f;
/** Offsets that lie nearer to each other can be one: floats are good to a millimetre over that. */
constexpr double kRegion_m = 1e4;
/** Coarser rounding would be all that a registration sees. */
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

/** For files that do not say where the sensor stood. */
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

/** Whether many points lie far behind others as seen from the sensor: a map, which was seen from
 * many places. */
bool isMap(const Loaded& loaded) {
  constexpr size_t kPoints = 30000;
  constexpr double kManyHidden = 0.4;
  const std::vector<Vector3f>& points = loaded.cloud.points;
  std::vector<Vector3f> some;
  for (size_t i = 0; i < points.size(); i += std::max<size_t>(1, points.size() / kPoints))
    some.push_back(points[i]);
  const NearestRanges ranges(some, loaded.viewpoint);
  const auto hidden = std::count_if(some.begin(), some.end(),
                                    [&](const Vector3f& point) { return ranges.hides(point); });
  return static_cast<double>(hidden) > kManyHidden * static_cast<double>(some.size());
}

std::vector<std::string> notesOn(const Loaded& loaded, const Loaded& other) {
  std::vector<std::string> notes;
  if (loaded.cloud.rounded_to_m > 0)
    notes.push_back(
        format("its coordinates had been rounded to %.3f m as floats", loaded.cloud.rounded_to_m));
  if (!loaded.cloud.viewpoint)
    notes.push_back("it does not say where the sensor stood: its middle is taken");
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

/** Thins the scan as the front end does. Where most of what is left then stands alone in space,
 * that is noise, which no voxel filter thins, and the surfaces have got too coarse: once more
 * without. */
void thin(Scan& scan, RegisteredCloud& result, const AdaptiveVoxelOptions& options) {
  const auto thinned = [&](const Scan& from) {
    AdaptiveVoxelFilter filter(options);
    Scan filtered = filter.filter(from);
    result.leaf_m = filter.leaf();
    return filtered;
  };
  Scan filtered = thinned(scan);
  const Scan rest = withoutLonePoints(scan, options.max_leaf_m);
  const size_t lone = scan.size() - rest.size();
  if (2 * lone > filtered.size()) {
    result.left_out += lone;
    result.notes.push_back(
        format("%zu points that have no other within %.1f m are left out as noise", lone,
               options.max_leaf_m));
    filtered = thinned(rest);
  }
  scan = std::move(filtered);
}

RegisteredCloud registeredCloud(Loaded loaded, std::vector<std::string> notes,
                                const FrontEndOptions& options) {
  RegisteredCloud result;
  result.path = loaded.path;
  result.read = loaded.read;
  result.offset = loaded.cloud.offset;
  result.notes = std::move(notes);
  result.left_out = loaded.read - loaded.cloud.points.size();
  if (isMap(loaded)) result.map = loaded.cloud.points;
  Scan scan;
  scan.points = std::move(loaded.cloud.points);
  scan.sensors = {{"lidar", loaded.viewpoint.cast<double>()}};
  scan.sensor.assign(scan.size(), 0);
  if (!options.keyed && scan.size() > static_cast<size_t>(options.voxel.target_points))
    thin(scan, result, options.voxel);
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
