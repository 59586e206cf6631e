#include "lamp/core/SurfaceNormals.h"

#include <Eigen/Eigenvalues>

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

/** Direction of least scatter; zero if the points do not span a surface. */
Vector3f surfaceNormal(const Matrix3f& scatter) {
  Eigen::SelfAdjointEigenSolver<Matrix3f> eigen;
  eigen.computeDirect(scatter);
  const Vector3f values = eigen.eigenvalues();
  if (!(values[1] > 1e-3f * values[2])) return Vector3f::Zero();
  return eigen.eigenvectors().col(0).normalized();
}

Vector3f lineNormal(const Matrix3f& scatter) {
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix2f> eigen;
  eigen.computeDirect(scatter.topLeftCorner<2, 2>());
  const Eigen::Vector2f values = eigen.eigenvalues();
  if (!(values[1] > 0.0f)) return Vector3f::Zero();
  const Eigen::Vector2f normal = eigen.eigenvectors().col(0).normalized();
  return {normal.x(), normal.y(), 0.0f};
}

}  // namespace

std::vector<Vector3f> surfaceNormals(const std::vector<Vector3f>& points, const KdTree& tree,
                                     int neighbors, bool planar) {
  std::vector<Vector3f> normals(points.size(), Vector3f::Zero());
  std::vector<uint32_t> nearest;
  for (size_t i = 0; i < points.size(); ++i) {
    tree.nearest(points[i], static_cast<size_t>(neighbors), nearest);
    if (nearest.size() < kMinNeighborsForNormal) continue;
    const Matrix3f spread = scatter(points, nearest);
    const Vector3f normal = planar ? lineNormal(spread) : surfaceNormal(spread);
    if (normal.allFinite()) normals[i] = normal;
  }
  return normals;
}

}  // namespace lamp
