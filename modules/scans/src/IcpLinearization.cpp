#include "IcpLinearization.h"

#include <Eigen/Cholesky>

namespace lamp {

namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

double gemanMcClure(double squared_residual, double kernel_m) {
  const double s = kernel_m * kernel_m;
  return (s / (s + squared_residual)) * (s / (s + squared_residual));
}

/** Derivative of a distance along `direction` by the motion. */
Vector6d derivative(const Vector3d& direction, const Vector3d& lever) {
  Vector6d j;
  j << direction, lever.cross(direction);
  return j;
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

}  // namespace

Vector6d solveStep(const IcpNormalEquations& equations, bool planar) {
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

Pose3 movedAbout(const Vector3d& pivot, const Vector6d& step, const Pose3& T) {
  return normalized(Eigen::Translation3d(pivot) * expSE3(step) * Eigen::Translation3d(-pivot) * T);
}

Linearization::Linearization(IcpMetric metric, double plane_thickness, double kernel_m)
    : plane_to_plane_(metric == IcpMetric::kPlaneToPlane),
      thickness_(plane_thickness),
      kernel_m_(kernel_m) {}

void Linearization::add(const Vector3d& lever, const Vector3d& r, const Vector3d& n,
                        const Vector3d& m) {
  if (n.dot(m) < 0) return;  // two sides of a wall, or a floor and a ceiling
  const double distance = n.dot(r);
  double weight;
  if (plane_to_plane_) {
    weight = addPlaneToPlane(lever, r, n, m);
  } else {
    const Vector6d jn = derivative(n, lever);
    weight = gemanMcClure(distance * distance, kernel_m_);
    addOuterProduct(weight, jn, sum_.H);
    sum_.g += weight * distance * jn;
  }
  sum_.weights += weight;
  sum_.squares += weight * distance * distance;
  ++sum_.matches;
}

/** The residual's weight is 2 e C⁻¹ of C = 2 - (1 - e)(n nᵀ + m mᵀ), in closed form: C's
 * eigenvectors are n + m and n - m. Scaled so that a distance across parallel surfaces counts once.
 * \return the kernel's weight. */
double Linearization::addPlaneToPlane(const Vector3d& lever, const Vector3d& r, const Vector3d& n,
                                      const Vector3d& m) {
  const double k = 1.0 - thickness_;
  const double c = n.dot(m);
  const Vector3d a = n + m, b = n - m;
  const double wa = thickness_ * k / (2.0 * (2.0 - k * (1.0 + c)));
  const double wb = thickness_ * k / (2.0 * (2.0 - k * (1.0 - c)));
  const double ra = a.dot(r), rb = b.dot(r);
  const double weight =
      gemanMcClure(thickness_ * r.squaredNorm() + wa * ra * ra + wb * rb * rb, kernel_m_);
  const Vector6d ja = derivative(a, lever), jb = derivative(b, lever);
  addOuterProduct(weight * wa, ja, sum_.H);
  addOuterProduct(weight * wb, jb, sum_.H);
  sum_.g += weight * (wa * ra * ja + wb * rb * jb);
  addIsotropic(weight * thickness_, lever, r);
  return weight;
}

void Linearization::addIsotropic(double weight, const Vector3d& lever, const Vector3d& r) {
  isotropic_ += weight;
  levers_ += weight * lever;
  lever_squares_.noalias() += weight * lever * lever.transpose();
  sum_.g.head<3>() += weight * r;
  sum_.g.tail<3>() += weight * lever.cross(r);
}

IcpNormalEquations Linearization::result() const {
  IcpNormalEquations result = sum_;
  result.H = symmetric(sum_.H);
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

}  // namespace lamp
