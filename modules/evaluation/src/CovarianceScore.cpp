#include "lamp/evaluation/CovarianceScore.h"

#include <Eigen/Eigenvalues>
#include <cmath>

namespace lamp::evaluation {

namespace {

constexpr double kUnknown = 1e-2, kGiven = 1e10;  ///< information
/** An axis of which no more than this part is unknown or given is one that the pose knows. */
constexpr double kKnownPart = 1e-3;
constexpr double kChiSquare95[] = {0, 3.841, 5.991, 7.815, 9.488, 11.070, 12.592};

}  // namespace

CovarianceScore scoreCovariances(const std::vector<ClaimedPose>& poses) {
  CovarianceScore score;
  size_t beyond = 0;
  std::array<double, 6> sums{};
  std::array<size_t, 6> counts{};
  for (const ClaimedPose& pose : poses) {
    const Eigen::SelfAdjointEigenSolver<Matrix6d> eigen(pose.information);
    const Vector6d error = logSE3(pose.error);
    Vector6d variances = Vector6d::Zero(), not_known = Vector6d::Zero();
    double squared = 0;
    int freedom = 0;
    for (int k = 0; k < 6; ++k) {
      const Vector6d axis = eigen.eigenvectors().col(k);
      const double information = eigen.eigenvalues()[k];
      if (!(information > kUnknown && information < kGiven)) {
        not_known += axis.cwiseAbs2();
        continue;
      }
      ++freedom;
      squared += information * std::pow(axis.dot(error), 2);
      variances += axis.cwiseAbs2() / information;
    }
    if (freedom == 0) continue;
    ++score.count;
    if (squared > kChiSquare95[freedom]) ++beyond;
    for (int axis = 0; axis < 6; ++axis) {
      if (not_known[axis] > kKnownPart) continue;
      sums[static_cast<size_t>(axis)] += error[axis] * error[axis] / variances[axis];
      ++counts[static_cast<size_t>(axis)];
    }
  }
  if (score.count > 0)
    score.beyond_95 = static_cast<double>(beyond) / static_cast<double>(score.count);
  for (size_t axis = 0; axis < 6; ++axis)
    if (counts[axis] > 0)
      score.normalized_variance[axis] = sums[axis] / static_cast<double>(counts[axis]);
  return score;
}

}  // namespace lamp::evaluation
