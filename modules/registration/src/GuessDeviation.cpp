#include "lamp/registration/GuessDeviation.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "lamp/core/ChiSquare.h"

IMPLEMENTS_MRPT_OBJECT(GuessDeviation, lamp::Verifier, lamp)

namespace lamp {

namespace {

/** Squared length of the deviation by the sum of a covariance and the inverse of an information
 * matrix, which may be singular: unobserved directions do not count. (P + L⁻¹)⁻¹ =
 * L - L (P⁻¹ + L)⁻¹ L. */
double mahalanobis2(const Vector6d& deviation, const Matrix6d& covariance,
                    const Matrix6d& information) {
  const Vector6d weighted = information * deviation;
  const Matrix6d sum = covariance.inverse() + information;
  return deviation.dot(weighted) - weighted.dot(sum.ldlt().solve(weighted));
}

}  // namespace

void GuessDeviationOptions::visit(OptionVisitor& v) {
  v("probability", probability, "", "share of right registrations that pass", {0.5, 1.0 - 1e-12});
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

  const int axes = source.planar() && target.planar() ? 3 : 6;
  const int observed = std::max(1, axes - static_cast<int>(result.unobserved.size()));
  const double d2 = mahalanobis2(deviation, guessed, result.information);
  const double limit = chiSquareQuantile(options.probability, observed);
  Verification verification;
  verification.scores = {{"guess_chi2", d2, limit}};
  if (!(d2 <= limit)) verification.refusal = "far from the guess";
  return verification;
}

}  // namespace lamp
