#include "lamp/frontend/SurveyLocalizer.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "lamp/scans/RegistrationInformation.h"
#include "lamp/scans/ScanToMap.h"

namespace lamp {

namespace {

constexpr double kDegree = M_PI / 180.0;

/** What a start pose is good to, whatever its covariance states. */
constexpr double kStartM = 0.5, kStartRad = 3.0 * kDegree;
/** Scans are sought within this first: what lies farther off only confuses where the prediction is
 * good; and never farther than the second. */
constexpr double kNearM = 0.8, kFarM = 3.0;
/** A point may lie so many standard deviations of the prediction off. */
constexpr double kSigmas = 3.0;
/** A scan of which less lies on the survey's surfaces was taken outside it, or elsewhere in it.
 * Surveys are complete, so it is more than what a map that grows with the robot asks for. */
constexpr double kLeastShare = 0.5;
/** A scan that deviates by more from where odometry puts it, squared, in standard deviations over
 * the degrees of freedom, contradicts it. */
constexpr double kContradiction = 16.0;
/** What is wrong with all patches of a scan alike is so small a part of what is wrong with each. */
constexpr double kCommonShare = 0.1;

Matrix6d diagonal(double sigma_m, double sigma_rad) {
  Vector6d variances;
  variances.head<3>().setConstant(sigma_m * sigma_m);
  variances.tail<3>().setConstant(sigma_rad * sigma_rad);
  return variances.asDiagonal();
}

double rmsRange(const std::vector<Eigen::Vector3f>& points) {
  double sum = 0;
  for (const Eigen::Vector3f& point : points) sum += point.cast<double>().squaredNorm();
  return std::sqrt(sum / std::max<double>(1, static_cast<double>(points.size())));
}

/** The part of a motion of which the information says something. What is known badly, as the place
 * along a tunnel, would else follow each correction of what is known well. */
Vector6d observedPart(const Vector6d& motion, const Matrix6d& information) {
  constexpr double kNothing = 1e-9;
  const Eigen::SelfAdjointEigenSolver<Matrix6d> eigen(information);
  Vector6d part = Vector6d::Zero();
  for (int i = 0; i < 6; ++i)
    if (eigen.eigenvalues()[i] > kNothing * eigen.eigenvalues()[5])
      part += eigen.eigenvectors().col(i).dot(motion) * eigen.eigenvectors().col(i);
  return part;
}

/** \param error_m how far a point may lie from where the prediction puts it. */
ScanToMapResult search(const std::vector<Eigen::Vector3f>& points, LocalMap& survey,
                       const Pose3& predicted, double error_m) {
  ScanToMapResult near = registerToMap(points, survey, predicted, std::min(kNearM, error_m));
  if (error_m <= kNearM || (near.converged && near.matched_share >= kLeastShare)) return near;
  return registerToMap(points, survey, predicted, std::min(kFarM, error_m));
}

}  // namespace

SurveyLocalizer::SurveyLocalizer(LocalMap& survey, const StartPrior& start)
    : survey_(survey),
      pose_(start.world_T_base),
      covariance_(start.covariance + diagonal(kStartM, kStartRad)) {}

void SurveyLocalizer::predict(const OdometryEdge& motion) {
  pose_ = normalized(pose_ * motion.previous_T_this);
  covariance_ = composeCovariance(covariance_, motion.previous_T_this, motion.covariance);
}

bool SurveyLocalizer::correct(const std::vector<Eigen::Vector3f>& points) {
  const Vector6d sigmas = covariance_.diagonal().cwiseSqrt();
  const double error =
      kSigmas * (sigmas.head<3>().maxCoeff() + sigmas.tail<3>().maxCoeff() * rmsRange(points));
  const ScanToMapResult found = search(points, survey_, pose_, error);
  matched_share_ = found.matched_share;
  deviation_m_ = found.deviation_m;
  observed_ = false;
  if (!found.converged || found.matched_share < kLeastShare) return false;

  RegistrationInformationOptions options;
  options.common_share = kCommonShare;
  const RegistrationInformation knowledge =
      registrationInformation(found.surface, found.map_T_scan, options, false);
  observed_ = knowledge.unobserved.empty();
  const Matrix6d& information = knowledge.information;
  const Vector6d innovation = logSE3(pose_.inverse() * found.map_T_scan);
  // (P + I⁻¹)⁻¹ = I (1 + P I)⁻¹ needs no inverse of what may be singular.
  const Matrix6d blend = (Matrix6d::Identity() + covariance_ * information).inverse();
  const Matrix6d expected = information * blend;
  const auto freedom = static_cast<double>(Eigen::FullPivLU<Matrix6d>(information).rank());
  if (innovation.dot(expected * innovation) > kContradiction * std::max(1.0, freedom)) {
    // Either may be wrong. If the next scans say the same, the survey is right.
    covariance_ += diagonal(innovation.head<3>().norm(), innovation.tail<3>().norm());
    return false;
  }
  const Vector6d correction = covariance_ * expected * innovation;
  pose_ = normalized(pose_ * expSE3(observedPart(correction, information)));
  const Matrix6d left = blend * covariance_;
  covariance_ = 0.5 * (left + left.transpose());
  return true;
}

}  // namespace lamp
