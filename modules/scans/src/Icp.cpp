#include "lamp/scans/Icp.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace lamp {

namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Eigen::Vector3f;
using Matrix36d = Eigen::Matrix<double, 3, 6>;

constexpr size_t kMinMatches = 10;
/** Share of the in-plane variance that generalised ICP grants across the surface. */
constexpr double kPlaneThickness = 1e-3;

/** Normal equations of one Gauss-Newton step. */
struct NormalEquations {
  Matrix6d H = Matrix6d::Zero();
  Vector6d g = Vector6d::Zero();
  Matrix6d point_to_plane = Matrix6d::Zero();
  size_t matches = 0;
};

Matrix3d surfaceCovariance(const Vector3d& normal) {
  return Matrix3d::Identity() - (1.0 - kPlaneThickness) * normal * normal.transpose();
}

/** Weight matrix of the difference of two matched points, scaled so that a difference across the
 * surface counts about 1 per m². */
Matrix3d matchWeight(IcpMetric metric, const Vector3d& target_normal,
                     const Vector3d& source_normal) {
  if (metric == IcpMetric::kPointToPlane) return target_normal * target_normal.transpose();
  const Matrix3d C = surfaceCovariance(target_normal) + surfaceCovariance(source_normal);
  return 2.0 * kPlaneThickness * C.inverse();
}

double gemanMcClure(double squared_residual, double kernel_m) {
  const double s = kernel_m * kernel_m;
  return (s / (s + squared_residual)) * (s / (s + squared_residual));
}

NormalEquations linearise(const PreparedScan& source, const PreparedScan& target, const Pose3& T,
                          IcpMetric metric, double max_distance, double kernel_m) {
  NormalEquations sum;
  const Eigen::Isometry3f Tf = T.cast<float>();
  const Matrix3d R = T.linear();
  Matrix36d J;
  for (size_t i = 0; i < source.size(); ++i) {
    float squared;
    const size_t j =
        target.tree->nearest(Tf * source.points[i], static_cast<float>(max_distance), squared);
    if (j == KdTree::kNone || target.normals[j].isZero()) continue;
    const Vector3d p = source.points[i].cast<double>();
    const Vector3d n = target.normals[j].cast<double>();
    const Vector3d r = T * p - target.points[j].cast<double>();
    const Matrix3d W = matchWeight(metric, n, R * source.normals[i].cast<double>());
    J.leftCols<3>() = R;
    J.rightCols<3>() = -R * skew(p);
    const double weight = gemanMcClure(r.dot(W * r), kernel_m);
    const Matrix36d WJ = weight * W * J;
    sum.H.noalias() += J.transpose() * WJ;
    sum.g.noalias() += WJ.transpose() * r;
    const Vector6d h = J.transpose() * n;
    sum.point_to_plane.noalias() += weight * h * h.transpose();
    ++sum.matches;
  }
  return sum;
}

/** Gauss-Newton step; in the plane only x, y and yaw move. Slight damping leaves directions that
 * the scans do not observe where they are. */
Vector6d solveStep(const NormalEquations& equations, bool planar) {
  constexpr double kDamping = 1e-6;
  Vector6d step = Vector6d::Zero();
  if (!planar) {
    Matrix6d H = equations.H;
    H.diagonal() *= 1.0 + kDamping;
    H.diagonal().array() += kDamping;
    step = -H.ldlt().solve(equations.g);
  } else {
    Matrix3d H;
    Vector3d g;
    for (int a = 0; a < 3; ++a) {
      g[a] = equations.g[kPlanarAxes[a]];
      for (int b = 0; b < 3; ++b) H(a, b) = equations.H(kPlanarAxes[a], kPlanarAxes[b]);
    }
    H.diagonal().array() += kDamping;
    const Vector3d reduced = -H.ldlt().solve(g);
    for (int a = 0; a < 3; ++a) step[kPlanarAxes[a]] = reduced[a];
  }
  return step;
}

}  // namespace

void IcpOptions::visit(OptionVisitor& v) {
  v("max_iterations", max_iterations, "", "Gauss-Newton iterations at most", {1});
  v("start_correspondence_m", start_correspondence_m, "m",
    "how far partners may lie apart in the first iteration", kPositive);
  v("correspondence_m", correspondence_m, "m",
    "how far partners may lie apart in the last iterations", kPositive);
  v("shrink_factor", shrink_factor, "", "shrinks that distance after each iteration", {0.1, 0.99});
  v("kernel_m", kernel_m, "m", "residual at which a match loses three quarters of its weight",
    kPositive);
  v("translation_tolerance_m", translation_tolerance_m, "m", "a smaller step ends the iterations",
    kPositive);
  v("rotation_tolerance_deg", rotation_tolerance_deg, "deg", "a smaller step ends the iterations",
    kPositive);
}

IcpResult icp(const PreparedScan& source, const PreparedScan& target, const Pose3& start,
              IcpMetric metric, const IcpOptions& options) {
  IcpResult result;
  result.target_T_source = start;
  const bool planar = source.planar && target.planar;
  const double rotation_tolerance = options.rotation_tolerance_deg * M_PI / 180.0;
  double distance = std::max(options.start_correspondence_m, options.correspondence_m);
  while (result.iterations < options.max_iterations) {
    // The kernel narrows with the search distance: coarse matches still pull, fine ones decide.
    const double kernel = options.kernel_m * distance / options.correspondence_m;
    const NormalEquations equations =
        linearise(source, target, result.target_T_source, metric, distance, kernel);
    ++result.iterations;
    result.matches = equations.matches;
    result.information = equations.point_to_plane;
    if (equations.matches < kMinMatches) return result;
    const Vector6d step = solveStep(equations, planar);
    if (!step.allFinite()) return result;
    result.target_T_source = normalized(result.target_T_source * expSE3(step));
    const bool fine = distance <= options.correspondence_m;
    if (fine && step.head<3>().norm() < options.translation_tolerance_m &&
        step.tail<3>().norm() < rotation_tolerance) {
      result.converged = true;
      return result;
    }
    distance = std::max(options.correspondence_m, distance * options.shrink_factor);
  }
  return result;
}

Agreement agreement(const PreparedScan& source, const PreparedScan& target,
                    const Pose3& target_T_source, double distance_m) {
  const float kCosineOf45Degrees = std::sqrt(0.5f);
  const Eigen::Isometry3f T = target_T_source.cast<float>();
  Agreement result;
  double squares = 0;
  for (size_t i = 0; i < source.size(); ++i) {
    const Vector3f p = T * source.points[i];
    float squared;
    const size_t j = target.tree->nearest(p, static_cast<float>(distance_m), squared);
    if (j == KdTree::kNone) continue;
    const Vector3f normal = T.linear() * source.normals[i];
    if (std::abs(normal.dot(target.normals[j])) < kCosineOf45Degrees) continue;
    const double along_normal = target.normals[j].dot(p - target.points[j]);
    squares += along_normal * along_normal;
    ++result.matches;
  }
  if (result.matches == 0) return result;
  result.overlap = static_cast<double>(result.matches) / static_cast<double>(source.size());
  result.residual_m = std::sqrt(squares / static_cast<double>(result.matches));
  return result;
}

}  // namespace lamp
