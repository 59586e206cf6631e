#include "lamp/core/ScanOverlap.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "lamp/core/SurfaceNormals.h"

namespace lamp {

namespace {

using Eigen::Vector3f;

constexpr float kVoxel = 0.2f, kPartnerDistance = 0.3f;
constexpr float kCosineOf45Degrees = 0.70710678f;
constexpr int kNormalNeighbors = 10;

/** The mean of the points in each voxel, in the order of the voxels. */
std::vector<Vector3f> voxelMeans(const std::vector<Vector3f>& points) {
  struct Sum {
    Eigen::Vector3d point = Eigen::Vector3d::Zero();
    int count = 0;
  };
  std::map<std::array<float, 3>, Sum> voxels;
  for (const Vector3f& p : points) {
    if (!p.allFinite()) continue;
    const Vector3f cell = (p / kVoxel).array().floor();
    Sum& sum = voxels[{cell.x(), cell.y(), cell.z()}];
    sum.point += p.cast<double>();
    ++sum.count;
  }
  std::vector<Vector3f> means;
  means.reserve(voxels.size());
  for (const auto& [cell, sum] : voxels) means.push_back((sum.point / sum.count).cast<float>());
  return means;
}

}  // namespace

OverlapScan::OverlapScan(const std::vector<Vector3f>& points, bool planar)
    : points_(voxelMeans(points)),
      normals_(),
      tree_(points_),
      min_(Vector3f::Zero()),
      max_(Vector3f::Zero()) {
  normals_ = fitPlanes(points_, tree_, kNormalNeighbors, planar).normals;
  if (points_.empty()) return;
  min_ = max_ = points_.front();
  for (const Vector3f& p : points_) {
    min_ = min_.cwiseMin(p);
    max_ = max_.cwiseMax(p);
  }
}

double OverlapScan::shareWithPartner(const OverlapScan& other,
                                     const Eigen::Isometry3f& other_T_this) const {
  const Vector3f low = other.min_.array() - kPartnerDistance;
  const Vector3f high = other.max_.array() + kPartnerDistance;
  size_t partners = 0;
  for (size_t i = 0; i < size(); ++i) {
    const Vector3f p = other_T_this * points_[i];
    if ((p.array() < low.array()).any() || (p.array() > high.array()).any()) continue;
    const Vector3f normal = other_T_this.linear() * normals_[i];
    if (other.tree_.anyWithin(p, kPartnerDistance, [&](size_t j) {
          return std::abs(normal.dot(other.normals_[j])) >= kCosineOf45Degrees;
        }))
      ++partners;
  }
  return static_cast<double>(partners) / static_cast<double>(size());
}

/** The spheres around both bounding boxes lie too far apart for any partner. */
bool OverlapScan::isFarFrom(const OverlapScan& other, const Pose3& this_T_other) const {
  const Vector3f center = 0.5f * (min_ + max_), other_center = 0.5f * (other.min_ + other.max_);
  const float radii = 0.5f * ((max_ - min_).norm() + (other.max_ - other.min_).norm());
  return (this_T_other.cast<float>() * other_center - center).norm() > radii + kPartnerDistance;
}

double scanOverlap(const OverlapScan& a, const OverlapScan& b, const Pose3& a_T_b) {
  if (a.size() == 0 || b.size() == 0 || a.isFarFrom(b, a_T_b)) return 0;
  const double share_of_b = b.shareWithPartner(a, a_T_b.cast<float>());
  if (share_of_b == 0) return 0;
  return std::min(share_of_b, a.shareWithPartner(b, a_T_b.inverse().cast<float>()));
}

}  // namespace lamp
