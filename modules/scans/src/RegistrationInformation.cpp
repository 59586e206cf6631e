#include "lamp/scans/RegistrationInformation.h"

#include <Eigen/Cholesky>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <cstdio>

namespace lamp {

namespace {

using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Vector3d;

std::string describe(const char* motion, const Vector3d& axis) {
  char text[80];
  std::snprintf(text, sizeof text, "%s (%.2f %.2f %.2f)", motion, axis.x(), axis.y(), axis.z());
  return text;
}

/** Motions about the pivot, rotations as lengths at the radius, that meet no resistance: each weak
 * axis with what the other kind of motion does to go along. */
class WeakMotions {
 public:
  WeakMotions(const Matrix6d& scaled, const Observability& observability,
              const RegistrationInformationOptions& options, bool planar)
      : scaled_(scaled), planar_(planar) {
    for (int k = 0; k < 3; ++k)
      if (observability.translation[k] < options.min_translation_observability)
        add("translation along", observability.translations.col(k), 0);
    for (int k = 0; k < 3; ++k)
      if (observability.rotation[k] < options.min_rotation_observability)
        add("rotation about", observability.rotations.col(k), 3);
  }

  /** Orthonormal basis of all other motions, as columns. */
  MatrixXd observed() const {
    if (motions_.cols() == 0) return Matrix6d::Identity();
    const Eigen::ColPivHouseholderQR<MatrixXd> qr(motions_);
    const MatrixXd Q = qr.householderQ();
    return Q.rightCols(6 - qr.rank());
  }
  const std::vector<std::string>& names() const { return names_; }

 private:
  void add(const char* name, const Vector3d& axis, int first) {
    const int other = 3 - first;
    const Matrix3d block = scaled_.block<3, 3>(other, other);
    Vector6d motion = Vector6d::Zero();
    motion.segment<3>(first) = axis;
    motion.segment<3>(other) =
        -block.completeOrthogonalDecomposition().solve(scaled_.block<3, 3>(other, first) * axis);
    motions_.conservativeResize(6, motions_.cols() + 1);
    motions_.rightCols<1>() = motion.normalized();
    // Nobody moves out of the plane, so nobody misses what is not known of that.
    const bool in_plane = (std::abs(axis.z()) < 0.5) == (first == 0);
    if (!planar_ || in_plane) names_.push_back(describe(name, axis));
  }

  const Matrix6d& scaled_;
  const bool planar_;
  MatrixXd motions_{6, 0};
  std::vector<std::string> names_;
};

}  // namespace

void RegistrationInformationOptions::visit(OptionVisitor& v) {
  v("sigma_m", sigma_m, "m", "noise of a surface patch, added to that of the residuals", kPositive);
  v("min_translation_observability", min_translation_observability, "",
    "translations constrained by a smaller fraction of the points get no information", kShare);
  v("min_rotation_observability", min_rotation_observability, "",
    "the same for rotations, as lengths at the points' r.m.s. distance; smaller because lever arms "
    "about a tunnel's axis are short",
    kShare);
  v("common_share", common_share, "",
    "fraction of the patches' deviation that all patches share (a bent scan), which no number of "
    "patches averages out",
    kPositive);
}

RegistrationInformation registrationInformation(const MatchedSurface& surface,
                                                const Pose3& target_T_source,
                                                const RegistrationInformationOptions& options,
                                                bool planar) {
  RegistrationInformation result;
  if (!(surface.weights > 0) || !(surface.radius_m > 0)) return result;
  result.observability = observability(surface.information, surface.weights, surface.radius_m);
  // Rotations as lengths at the radius: only so can the six directions be compared.
  Vector6d scale = Vector6d::Ones();
  scale.tail<3>() /= surface.radius_m;
  const Matrix6d scaled =
      scale.asDiagonal() * surface.information * scale.asDiagonal() / surface.weights;
  const WeakMotions weak(scaled, result.observability, options, planar);
  const MatrixXd Q = weak.observed();
  for (const std::string& name : weak.names()) result.unobserved.push_back(name);
  if (Q.cols() == 0) return result;

  const double variance =
      options.sigma_m * options.sigma_m + surface.residual_m * surface.residual_m;
  const double common = options.common_share * options.common_share * variance;
  const MatrixXd A = Q.transpose() * scaled * Q * surface.patches / variance;
  const MatrixXd covariance = A.completeOrthogonalDecomposition().pseudoInverse() +
                              common * MatrixXd::Identity(Q.cols(), Q.cols());
  const Matrix6d about_pivot = Q * covariance.inverse() * Q.transpose();
  // Back from lengths to radians, and from the pivot to the tangent space at the pose.
  Matrix6d to_scaled = Matrix6d::Identity();
  to_scaled.bottomRightCorner<3, 3>() *= surface.radius_m;
  const Matrix6d J = to_scaled * adjoint(Eigen::Translation3d(-surface.pivot) * target_T_source);
  result.information = J.transpose() * about_pivot * J;
  result.information = 0.5 * (result.information + result.information.transpose()).eval();
  return result;
}

}  // namespace lamp
