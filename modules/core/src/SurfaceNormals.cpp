#include "lamp/core/SurfaceNormals.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace lamp {

namespace {

using Eigen::Matrix3f;
using Eigen::Vector3f;

constexpr size_t kMinNeighborsForNormal = 3;

/** Scatter of the points around their mean. */
Matrix3f scatter(const std::vector<Vector3f>& points, const std::vector<uint32_t>& indices) {
  Vector3f mean = Vector3f::Zero();
  for (const uint32_t i : indices) mean += points[i];
  mean /= static_cast<float>(indices.size());
  Matrix3f sum = Matrix3f::Zero();
  for (const uint32_t i : indices) {
    const Vector3f d = points[i] - mean;
    sum.noalias() += d * d.transpose();
  }
  return sum;
}

/** A plane's normal, the scatter across it and the largest one along it. */
struct Plane {
  Vector3f normal = Vector3f::Zero();
  float across = 0, along = 0;
};

/** Across the direction of least scatter; none if the points do not span a surface. */
Plane planeOf(const Matrix3f& scatter) {
  Eigen::SelfAdjointEigenSolver<Matrix3f> eigen;
  eigen.computeDirect(scatter);
  const Vector3f values = eigen.eigenvalues();
  if (!(values[1] > 1e-3f * values[2])) return {};
  return {eigen.eigenvectors().col(0).normalized(), std::max(0.0f, values[0]), values[2]};
}

Plane lineOf(const Matrix3f& scatter) {
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix2f> eigen;
  eigen.computeDirect(scatter.topLeftCorner<2, 2>());
  const Eigen::Vector2f values = eigen.eigenvalues();
  if (!(values[1] > 0.0f)) return {};
  const Eigen::Vector2f normal = eigen.eigenvectors().col(0).normalized();
  return {{normal.x(), normal.y(), 0.0f}, std::max(0.0f, values[0]), values[1]};
}

}  // namespace

FittedPlanes fitPlanes(const std::vector<Vector3f>& points, const KdTree& tree, int neighbors,
                       bool planar) {
  const size_t parameters = planar ? 2 : 3;
  FittedPlanes fitted{std::vector<Vector3f>(points.size(), Vector3f::Zero()),
                      std::vector<float>(points.size(), 0.0f),
                      std::vector<float>(points.size(), 0.0f)};
  std::vector<uint32_t> nearest;
  for (size_t i = 0; i < points.size(); ++i) {
    tree.nearest(points[i], static_cast<size_t>(neighbors), nearest);
    if (nearest.size() < kMinNeighborsForNormal) continue;
    const Matrix3f spread = scatter(points, nearest);
    const Plane plane = planar ? lineOf(spread) : planeOf(spread);
    if (!plane.normal.allFinite()) continue;
    fitted.normals[i] = plane.normal;
    const auto count = static_cast<float>(nearest.size());
    fitted.extents_m[i] = std::sqrt(plane.along / count);
    if (nearest.size() > parameters)
      fitted.deviations_m[i] = std::sqrt(plane.across / (count - static_cast<float>(parameters)));
  }
  return fitted;
}

}  // namespace lamp
