#include "lamp/registration/Refiner.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

IMPLEMENTS_VIRTUAL_MRPT_OBJECT(Refiner, Stage, lamp)
IMPLEMENTS_MRPT_OBJECT(Gicp, lamp::Refiner, lamp)
IMPLEMENTS_MRPT_OBJECT(PointToPlane, lamp::Refiner, lamp)

namespace lamp {

namespace {

/** Inverse with eigenvalues limited to `max_variance`. */
Eigen::MatrixXd limitedInverse(const Eigen::MatrixXd& information, double max_variance) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(information);
  const Eigen::VectorXd variances = eigen.eigenvalues().unaryExpr(
      [&](double value) { return value * max_variance > 1.0 ? 1.0 / value : max_variance; });
  return eigen.eigenvectors() * variances.asDiagonal() * eigen.eigenvectors().transpose();
}

RegistrationResult refineWith(IcpMetric metric, const RefinerOptions& options,
                              const PreparedScan& source, const PreparedScan& target,
                              const Hypothesis& hypothesis) {
  const IcpResult icp_result = icp(source, target, hypothesis.target_T_source, metric, options.icp);
  RegistrationResult result;
  result.target_T_source = icp_result.target_T_source;
  result.converged = icp_result.converged;
  result.iterations = icp_result.iterations;
  result.covariance = registrationCovariance(icp_result.information, options.covariance,
                                             source.planar && target.planar);
  return result;
}

}  // namespace

Matrix6d registrationCovariance(const Matrix6d& information,
                                const RegistrationCovarianceOptions& options, bool planar) {
  const double variance = options.sigma_m * options.sigma_m * options.correlated_points;
  const double max_variance = options.max_sigma_m * options.max_sigma_m;
  Matrix6d covariance = Matrix6d::Identity();
  if (planar) {
    Eigen::Matrix3d A;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) A(i, j) = information(kPlanarAxes[i], kPlanarAxes[j]);
    const Eigen::Matrix3d inverse = limitedInverse(A / variance, max_variance);
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) covariance(kPlanarAxes[i], kPlanarAxes[j]) = inverse(i, j);
  } else {
    covariance = limitedInverse(information / variance, max_variance);
  }
  const double floor_rad = options.floor_sigma_deg * M_PI / 180.0;
  covariance.diagonal().head<3>().array() += options.floor_sigma_m * options.floor_sigma_m;
  covariance.diagonal().tail<3>().array() += floor_rad * floor_rad;
  return 0.5 * (covariance + covariance.transpose());
}

void RegistrationCovarianceOptions::visit(OptionVisitor& v) {
  v("sigma_m", sigma_m, "m", "noise of one point across its surface", kPositive);
  v("correlated_points", correlated_points, "", "neighbouring points that count as one", {1});
  v("floor_sigma_m", floor_sigma_m, "m", "added to each coordinate: what the model leaves out",
    kPositive);
  v("floor_sigma_deg", floor_sigma_deg, "deg", "added to each angle: what the model leaves out",
    kPositive);
  v("max_sigma_m", max_sigma_m, "m", "given to directions that the scans do not observe",
    kPositive);
}

void RefinerOptions::visit(OptionVisitor& v) {
  icp.visit(v);
  covariance.visit(v);
}

RegistrationResult Gicp::refine(const PreparedScan& source, const PreparedScan& target,
                                const Hypothesis& hypothesis) const {
  return refineWith(IcpMetric::kPlaneToPlane, options, source, target, hypothesis);
}

RegistrationResult PointToPlane::refine(const PreparedScan& source, const PreparedScan& target,
                                        const Hypothesis& hypothesis) const {
  return refineWith(IcpMetric::kPointToPlane, options, source, target, hypothesis);
}

}  // namespace lamp
