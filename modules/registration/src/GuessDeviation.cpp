#include "lamp/registration/GuessDeviation.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include "lamp/core/ChiSquare.h"

IMPLEMENTS_MRPT_OBJECT(GuessDeviation, lamp::Verifier, lamp)

namespace lamp {

namespace {

/** Inverse of the sum of a covariance and the inverse of an information matrix, which may be
 * singular: unobserved directions do not count. (P + L⁻¹)⁻¹ = L - L (P⁻¹ + L)⁻¹ L. */
Matrix6d informationOfSum(const Matrix6d& covariance, const Matrix6d& information) {
  const Matrix6d sum = covariance.inverse() + information;
  return information - information * sum.ldlt().solve(information);
}

/** What is known of the position if nothing else is given: the rotation marginalised. */
Eigen::Matrix3d ofPosition(const Matrix6d& information) {
  const Eigen::Matrix3d rotation = information.bottomRightCorner<3, 3>();
  const Eigen::Matrix3d mixed = information.bottomLeftCorner<3, 3>();
  return information.topLeftCorner<3, 3>() -
         mixed.transpose() * rotation.completeOrthogonalDecomposition().solve(mixed);
}

/** Directions of the position that anything is known of. */
int rank(const Eigen::Matrix3d& information) {
  constexpr double kNothing = 1e-9;
  const Eigen::Vector3d known =
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(information, Eigen::EigenvaluesOnly)
          .eigenvalues();
  return static_cast<int>((known.array() > kNothing * known[2]).count());
}

}  // namespace

void GuessDeviationOptions::visit(OptionVisitor& v) {
  v("probability", probability, "", "probability that a correct registration passes",
    {0.5, 1.0 - 1e-12});
  v("slack_m", slack_m, "m", "standard deviation added to the guess's position", kPositive);
  v("slack_deg", slack_deg, "deg", "standard deviation added to the guess's rotation", kPositive);
}

Verification GuessDeviation::verify(const RegistrationResult& result, const PreparedScan& source,
                                    const PreparedScan& target, const Guess& guess) const {
  if (!guess.covariance) return {};
  const double slack_rad = options.slack_deg * M_PI / 180.0;
  Matrix6d guessed = *guess.covariance;
  guessed.diagonal().head<3>().array() += options.slack_m * options.slack_m;
  guessed.diagonal().tail<3>().array() += slack_rad * slack_rad;
  const Vector6d deviation = logSE3(guess.target_T_source.inverse() * result.target_T_source);

  const bool planar = source.planar() && target.planar();
  const Matrix6d information = informationOfSum(guessed, result.information);
  const Eigen::Matrix3d of_position = ofPosition(information);
  const Eigen::Vector3d shift = deviation.head<3>();
  Verification verification;
  const auto check = [&](const char* name, double d2, int directions) {
    const double limit = chiSquareQuantile(options.probability, std::max(1, directions));
    verification.scores.push_back({name, d2, limit});
    if (!(d2 <= limit)) verification.refusal = "far from the guess";
  };
  check("guess_chi2", deviation.dot(information * deviation),
        (planar ? 3 : 6) - static_cast<int>(result.unobserved.size()));
  check("guess_position_chi2", shift.dot(of_position * shift),
        std::min(rank(of_position), planar ? 2 : 3));
  return verification;
}

}  // namespace lamp
