#include "lamp/scans/Icp.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>

namespace lamp {

namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Eigen::Vector3f;

constexpr size_t kMinMatches = 10;
/** In the coarse iterations, and in the fine ones, about so many points take part. */
constexpr size_t kCoarsePoints = 500, kFinePoints = 1500;
/** Steps below so many tolerances end the coarse iterations. */
constexpr double kCoarseTolerance = 10;

/** Normal equations of one Gauss-Newton step, for a motion about the pivot in the target's axes. */
struct NormalEquations {
  Matrix6d H = Matrix6d::Zero();
  Vector6d g = Vector6d::Zero();
  Matrix6d point_to_plane = Matrix6d::Zero();
  double weights = 0;
  double squares = 0;  ///< weighted squared distances to the planes, metres²
  size_t matches = 0;
};

double gemanMcClure(double squared_residual, double kernel_m) {
  const double s = kernel_m * kernel_m;
  return (s / (s + squared_residual)) * (s / (s + squared_residual));
}

/** The upper triangle only. */
void addOuterProduct(double weight, const Vector6d& j, Matrix6d& sum) {
  for (int column = 0; column < 6; ++column) {
    const double scaled = weight * j[column];
    for (int row = 0; row <= column; ++row) sum(row, column) += scaled * j[row];
  }
}

Matrix6d symmetric(const Matrix6d& upper) {
  return upper.selfadjointView<Eigen::Upper>();
}

/** Sums the normal equations over matched points. */
class Linearization {
 public:
  Linearization(IcpMetric metric, double plane_thickness, double kernel_m)
      : plane_to_plane_(metric == IcpMetric::kPlaneToPlane),
        thickness_(plane_thickness),
        kernel_m_(kernel_m) {}

  /** \param lever from the pivot to the source point; \param r from the target to the source point;
   *  \param n target's normal; \param m source's normal; all in the target's axes. */
  void add(const Vector3d& lever, const Vector3d& r, const Vector3d& n, const Vector3d& m) {
    const double c = n.dot(m);
    if (c < 0) return;  // two sides of a wall, or a floor and a ceiling

    const Vector6d jn = derivative(n, lever);
    const double distance = n.dot(r);
    double weight;
    if (plane_to_plane_) {
      // 2 e C⁻¹ of C = 2 - (1 - e)(n nᵀ + m mᵀ), in closed form: C's eigenvectors are n + m and
      // n - m. Scaled so that a distance across parallel surfaces counts once.
      const double k = 1.0 - thickness_;
      const Vector3d a = n + m, b = n - m;
      const double wa = thickness_ * k / (2.0 * (2.0 - k * (1.0 + c)));
      const double wb = thickness_ * k / (2.0 * (2.0 - k * (1.0 - c)));
      const double ra = a.dot(r), rb = b.dot(r);
      weight = gemanMcClure(thickness_ * r.squaredNorm() + wa * ra * ra + wb * rb * rb, kernel_m_);
      const Vector6d ja = derivative(a, lever), jb = derivative(b, lever);
      addOuterProduct(weight * wa, ja, sum_.H);
      addOuterProduct(weight * wb, jb, sum_.H);
      sum_.g += weight * (wa * ra * ja + wb * rb * jb);
      addIsotropic(weight * thickness_, lever, r);
    } else {
      weight = gemanMcClure(distance * distance, kernel_m_);
      sum_.g += weight * distance * jn;
    }
    addOuterProduct(weight, jn, sum_.point_to_plane);
    sum_.weights += weight;
    sum_.squares += weight * distance * distance;
    ++sum_.matches;
  }

  NormalEquations result() const {
    NormalEquations result = sum_;
    result.point_to_plane = symmetric(sum_.point_to_plane);
    result.H = plane_to_plane_ ? symmetric(sum_.H) : result.point_to_plane;
    if (!plane_to_plane_) return result;
    // The isotropic part, J = [1, -lever x]: from the sums of lever and of lever leverᵀ.
    const Matrix3d L = skew(levers_);
    result.H.topLeftCorner<3, 3>() += isotropic_ * Matrix3d::Identity();
    result.H.topRightCorner<3, 3>() -= L;
    result.H.bottomLeftCorner<3, 3>() += L;
    result.H.bottomRightCorner<3, 3>() +=
        lever_squares_.trace() * Matrix3d::Identity() - lever_squares_;
    return result;
  }

 private:
  static Vector6d derivative(const Vector3d& direction, const Vector3d& lever) {
    Vector6d j;
    j << direction, lever.cross(direction);
    return j;
  }

  void addIsotropic(double weight, const Vector3d& lever, const Vector3d& r) {
    isotropic_ += weight;
    levers_ += weight * lever;
    lever_squares_.noalias() += weight * lever * lever.transpose();
    sum_.g.head<3>() += weight * r;
    sum_.g.tail<3>() += weight * lever.cross(r);
  }

  const bool plane_to_plane_;
  const double thickness_, kernel_m_;
  NormalEquations sum_;
  double isotropic_ = 0;
  Vector3d levers_ = Vector3d::Zero();
  Matrix3d lever_squares_ = Matrix3d::Zero();
};

/** The pairs of an alignment as it goes on: the partner of the last iteration bounds the search for
 * the next one. */
class Matcher {
 public:
  Matcher(const PreparedScan& source, const PreparedScan& target)
      : source_(source), target_(target), partners_(source.own().size(), KdTree::kNone) {}

  /** Every `stride`-th source point with its nearest target point within `max_distance`. */
  NormalEquations linearize(const Pose3& T, const Vector3d& pivot, double max_distance,
                            size_t stride, Linearization sum) {
    const Eigen::Isometry3f Tf = T.cast<float>();
    for (size_t k = 0; k < source_.own().size(); k += stride) {
      const uint32_t i = source_.own()[k];
      const Vector3f p = Tf * source_.points()[i];
      const size_t j = partner(k, p, static_cast<float>(max_distance));
      if (j == KdTree::kNone || target_.normals()[j].isZero()) continue;
      sum.add(p.cast<double>() - pivot, (p - target_.points()[j]).cast<double>(),
              target_.normals()[j].cast<double>(),
              (Tf.linear() * source_.normals()[i]).cast<double>());
    }
    return sum.result();
  }

  /** Cells of a metre with matched points. */
  double patches() const {
    std::set<std::tuple<int, int, int>> cells;
    for (size_t k = 0; k < source_.own().size(); ++k) {
      if (partners_[k] == KdTree::kNone) continue;
      const Vector3f& p = source_.points()[source_.own()[k]];
      cells.emplace(std::lround(p.x()), std::lround(p.y()), std::lround(p.z()));
    }
    return static_cast<double>(cells.size());
  }

 private:
  size_t partner(size_t k, const Vector3f& p, float max_distance) {
    float bound = max_distance, squared;
    size_t last = partners_[k];
    if (last != KdTree::kNone) {
      const float distance = (p - target_.points()[last]).norm();
      if (distance < max_distance)
        bound = distance;
      else
        last = KdTree::kNone;
    }
    const size_t nearer = target_.tree().nearest(p, bound, squared);
    return partners_[k] = nearer != KdTree::kNone ? nearer : last;
  }

  const PreparedScan& source_;
  const PreparedScan& target_;
  std::vector<size_t> partners_;
};

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

/** Moves the pose by a step about the pivot, in the target's axes. */
Pose3 movedAbout(const Vector3d& pivot, const Vector6d& step, const Pose3& T) {
  return normalized(Eigen::Translation3d(pivot) * expSE3(step) * Eigen::Translation3d(-pivot) * T);
}

Vector3d centroid(const PreparedScan& scan) {
  Vector3d sum = Vector3d::Zero();
  for (const uint32_t i : scan.own()) sum += scan.points()[i].cast<double>();
  return sum / std::max<double>(1.0, static_cast<double>(scan.own().size()));
}

double rmsDistance(const PreparedScan& scan, const Vector3d& center) {
  double sum = 0;
  for (const uint32_t i : scan.own())
    sum += (scan.points()[i].cast<double>() - center).squaredNorm();
  return std::sqrt(sum / std::max<double>(1.0, static_cast<double>(scan.own().size())));
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
  v("plane_thickness", plane_thickness, "",
    "variance across a surface, as a share of that along it", {1e-6, 1});
  v("translation_tolerance_m", translation_tolerance_m, "m", "a smaller step ends the iterations",
    kPositive);
  v("rotation_tolerance_deg", rotation_tolerance_deg, "deg", "a smaller step ends the iterations",
    kPositive);
}

IcpResult icp(const PreparedScan& source, const PreparedScan& target, const Pose3& start,
              IcpMetric metric, const IcpOptions& options) {
  IcpResult result;
  result.target_T_source = start;
  const bool planar = source.planar() && target.planar();
  const Vector3d source_centroid = centroid(source);
  result.radius_m = rmsDistance(source, source_centroid);
  Matcher matcher(source, target);
  double distance = std::max(options.start_correspondence_m, options.correspondence_m);
  const size_t fine_stride = std::max<size_t>(1, source.own().size() / kFinePoints);
  size_t stride = std::max<size_t>(1, source.own().size() / kCoarsePoints);
  while (result.iterations < options.max_iterations) {
    // The kernel narrows with the search distance: coarse matches still pull, fine ones decide.
    const double kernel = options.kernel_m * distance / options.correspondence_m;
    result.pivot = result.target_T_source * source_centroid;
    const NormalEquations equations =
        matcher.linearize(result.target_T_source, result.pivot, distance, stride,
                          Linearization(metric, options.plane_thickness, kernel));
    ++result.iterations;
    result.matches = equations.matches;
    result.information = equations.point_to_plane;
    result.weights = equations.weights;
    result.residual_m = std::sqrt(equations.squares / std::max(equations.weights, 1e-12));
    if (equations.matches < kMinMatches) return result;
    const Vector6d step = solveStep(equations, planar);
    if (!step.allFinite()) return result;
    result.target_T_source = movedAbout(result.pivot, step, result.target_T_source);
    const double share_of_tolerance =
        std::max(step.head<3>().norm() / options.translation_tolerance_m,
                 step.tail<3>().norm() / (options.rotation_tolerance_deg * M_PI / 180.0));
    if (distance > options.correspondence_m) {
      distance = std::max(options.correspondence_m, distance * options.shrink_factor);
    } else if (stride == fine_stride && share_of_tolerance < 1) {
      result.converged = true;
      result.patches = matcher.patches();
      return result;
    } else if (share_of_tolerance < kCoarseTolerance) {
      stride = fine_stride;
    }
  }
  return result;
}

}  // namespace lamp
