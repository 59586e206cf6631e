#include "lamp/scans/PreparedScan.h"

#include <algorithm>
#include <cmath>

#include "Extent.h"
#include "lamp/core/SurfaceNormals.h"

namespace lamp {

using Eigen::Vector3f;

namespace {

using Clock = std::chrono::steady_clock;

double secondsSince(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

/** Spreads the lowest 21 bits so that two more numbers fit between them. */
uint64_t spreadBits(uint64_t v) {
  v &= 0x1fffff;
  v = (v | v << 32) & 0x1f00000000ffff;
  v = (v | v << 16) & 0x1f0000ff0000ff;
  v = (v | v << 8) & 0x100f00f00f00f00f;
  v = (v | v << 4) & 0x10c30c30c30c30c3;
  v = (v | v << 2) & 0x1249249249249249;
  return v;
}

/** Place of a point on a curve through all cells that seldom leaves a neighbourhood (Morton). */
uint64_t mortonNumber(const Vector3f& p) {
  constexpr float kCell_m = 0.5f;
  const auto cell = [](float value) {
    return static_cast<uint64_t>(static_cast<int64_t>(std::floor(value / kCell_m)) + (1 << 20));
  };
  return spreadBits(cell(p.x())) | spreadBits(cell(p.y())) << 1 | spreadBits(cell(p.z())) << 2;
}

Cloud inNeighborlyOrder(const Cloud& cloud) {
  std::vector<std::pair<uint64_t, uint32_t>> order;
  order.reserve(cloud.size());
  for (uint32_t i = 0; i < cloud.size(); ++i)
    if (isUsable(cloud.points[i])) order.emplace_back(mortonNumber(cloud.points[i]), i);
  std::sort(order.begin(), order.end());
  Cloud result;
  result.viewpoints = cloud.viewpoints;
  result.own_viewpoints = cloud.own_viewpoints;
  for (const auto& [number, i] : order) {
    result.points.push_back(cloud.points[i]);
    result.viewpoint.push_back(cloud.viewpoint[i]);
  }
  return result;
}

/** 0 without values. */
float median(std::vector<float> values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/** Median distance from a point to the nearest other one, metres. */
float spacing(const Cloud& cloud, const KdTree& tree) {
  constexpr size_t kSamples = 250;
  std::vector<float> distances;
  std::vector<uint32_t> nearest;
  const size_t stride = std::max<size_t>(1, cloud.size() / kSamples);
  for (size_t i = 0; i < cloud.size(); i += stride) {
    tree.nearest(cloud.points[i], 2, nearest);
    if (nearest.size() == 2)
      distances.push_back((cloud.points[nearest[0]] - cloud.points[nearest[1]]).norm());
  }
  return median(std::move(distances));
}

/** Of the points where there is a plane. */
float medianWherePlane(const FittedPlanes& planes, const std::vector<float>& values) {
  std::vector<float> known;
  for (size_t i = 0; i < values.size(); ++i)
    if (!planes.normals[i].isZero()) known.push_back(values[i]);
  return median(std::move(known));
}

/** Planes whose neighbourhoods are wide compared to how far the points lie off them: where a 2D
 * laser is noisy, the nearest points are a disc, not a line. In space such points are no noise but
 * plants, and wider neighbourhoods would blur them. */
FittedPlanes fitWideEnough(const std::vector<Vector3f>& points, const KdTree& tree, int neighbors,
                           bool planar) {
  constexpr float kMaxUnevenness = 0.4f;
  constexpr int kMostDoublings = 3;
  FittedPlanes planes = fitPlanes(points, tree, neighbors, planar);
  const auto isUneven = [&] {
    return medianWherePlane(planes, planes.deviations_m) >
           kMaxUnevenness * medianWherePlane(planes, planes.extents_m);
  };
  for (int doubling = 0; planar && doubling < kMostDoublings && isUneven(); ++doubling) {
    neighbors *= 2;
    planes = fitPlanes(points, tree, neighbors, planar);
  }
  return planes;
}

double coarsenessOf(const Cloud& cloud, const KdTree& tree) {
  constexpr double kUsualSpacing_m = 0.4;
  return std::max(1.0, spacing(cloud, tree) / kUsualSpacing_m);
}

}  // namespace

void ScanPreparationOptions::visit(OptionVisitor& v) {
  v("normal_neighbors", normal_neighbors, "points", "number of nearest points used to fit a normal",
    {3});
  features.visit(v);
}

PreparedScan::PreparedScan(const Cloud& cloud, const ScanPreparationOptions& options, bool planar)
    : begun_(Clock::now()),
      feature_options_(options.features),
      planar_(planar),
      cloud_(inNeighborlyOrder(cloud)),
      tree_(cloud_.points),
      free_space_(cloud_),
      coarseness_(coarsenessOf(cloud_, tree_)) {
  for (uint32_t i = 0; i < cloud_.size(); ++i)
    if (cloud_.isOwn(i)) own_.push_back(i);
  FittedPlanes planes = fitWideEnough(cloud_.points, tree_, options.normal_neighbors, planar);
  noise_m_ = medianWherePlane(planes, planes.deviations_m);
  normals_ = std::move(planes.normals);
  turnTowardsViewpoints(cloud_, normals_);
  support_ = std::make_unique<SurfaceSupport>(cloud_, normals_, noise_m_, planar_);
  std::vector<Vector3f> own_points;
  for (const uint32_t i : own_) own_points.push_back(cloud_.points[i]);
  const Extent extent = extentOf(own_points);
  centroid_ = extent.centroid;
  radius_m_ = extent.radius_m;
  seconds_ = secondsSince(begun_);
}

const Features& PreparedScan::features() const {
  std::call_once(features_made_, [this] {
    const Clock::time_point begin = Clock::now();
    if (!planar_) features_ = computeFeatures(cloud_, feature_options_, coarseness_);
    seconds_ = seconds_ + secondsSince(begin);
  });
  return features_;
}

const OccupancyPyramid& PreparedScan::occupancy() const {
  std::call_once(occupancy_made_, [this] {
    const Clock::time_point begin = Clock::now();
    occupancy_.emplace(cloud_.points);
    seconds_ = seconds_ + secondsSince(begin);
  });
  return *occupancy_;
}

size_t PreparedScan::bytes() const {
  constexpr size_t kTreePerPoint = 24;  // leaves of ten points, an index each
  const auto keypoints = planar_ ? 0 : static_cast<size_t>(feature_options_.max_keypoints);
  return size() * (2 * sizeof(Vector3f) + 2 * sizeof(uint32_t) + kTreePerPoint +
                   SurfaceSupport::kBytesPerPoint) +
         free_space_.bytes() + (planar_ ? OccupancyPyramid::bytesFor(cloud_.points) : 0) +
         std::min(size(), keypoints) *
             (2 * sizeof(Vector3f) + Features::kDimensions * sizeof(float));
}

double coarseness(const PreparedScan& a, const PreparedScan& b) {
  return std::max(a.coarseness(), b.coarseness());
}

PreparedScanPtr prepareScan(std::vector<Vector3f> points, int normal_neighbors, bool planar) {
  ScanPreparationOptions options;
  options.normal_neighbors = normal_neighbors;
  return std::make_shared<PreparedScan>(cloudSeenFromOrigin(std::move(points)), options, planar);
}

}  // namespace lamp
