#include "lamp/registration/LookAlikes.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <utility>

#include "lamp/core/ChiSquare.h"
#include "lamp/registration/ObservedPart.h"
#include "lamp/scans/Agreement.h"
#include "lamp/scans/PatchEvidence.h"

namespace lamp {

namespace {

using Eigen::Matrix2d;
using Eigen::Matrix3d;
using Eigen::Vector2d;

/** Registrations converge from at least half this far away. */
constexpr double kStep_m = 1.5;
/** Starts with more of the points where the other scan's rays passed lead nowhere: across a
 * corridor, one of its walls does. */
constexpr double kMostInFreeSpace = 0.25, kMargin_m = 0.3;
/** Probability of the region that is searched. */
constexpr double kProbability = 0.99;

/** Horizontal covariance of the guess's position in the target's frame. */
Matrix2d horizontalCovariance(const Guess& guess) {
  const Matrix3d target_R_source = guess.target_T_source.linear();
  const Matrix3d covariance =
      target_R_source * guess.covariance->topLeftCorner<3, 3>() * target_R_source.transpose();
  return covariance.topLeftCorner<2, 2>();
}

/** How much of the surface stands in the way of horizontal shifts. */
Matrix2d resistance(const PreparedScan& scan) {
  Eigen::Matrix2f sum = Eigen::Matrix2f::Zero();
  for (const uint32_t i : scan.own())
    sum += scan.normals()[i].head<2>() * scan.normals()[i].head<2>().transpose();
  return sum.cast<double>();
}

/** Shifts along an axis that the scans do not observe lead to the same answer. */
bool isAnotherAnswer(const Pose3& start, const RegistrationResult& result) {
  const Vector6d motion = logSE3(result.target_T_source.inverse() * start);
  return observedPart(motion, result.information).head<3>().norm() > kStep_m / 2;
}

double largestEigenvalue(const Matrix2d& symmetric) {
  return Eigen::SelfAdjointEigenSolver<Matrix2d>(symmetric, Eigen::EigenvaluesOnly)
      .eigenvalues()[1];
}

/** Steps along the axes of least and most resistance, those that resist least first.
 * \param allowed ellipse about the guess. */
std::vector<Vector2d> shiftsWithin(const Matrix2d& allowed, const Vector2d& from_guess,
                                   const Matrix2d& resistance, int most) {
  const Eigen::SelfAdjointEigenSolver<Matrix2d> axes(resistance);
  const Matrix2d inverse = (allowed + kStep_m * kStep_m * Matrix2d::Identity()).inverse();
  std::vector<std::pair<double, Vector2d>> found;
  for (int i = -most; i <= most; ++i)
    for (int j = -most; j <= most; ++j) {
      const Vector2d steps(kStep_m * i, kStep_m * j), shift = axes.eigenvectors() * steps;
      const Vector2d there = from_guess + shift;
      if ((i != 0 || j != 0) && there.dot(inverse * there) < 1)
        found.push_back({axes.eigenvalues().dot(steps.cwiseAbs2()), shift});
    }
  std::stable_sort(found.begin(), found.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  found.resize(std::min(found.size(), static_cast<size_t>(most)));
  std::vector<Vector2d> shifts;
  for (const auto& [resists, shift] : found) shifts.push_back(shift);
  return shifts;
}

}  // namespace

void LookAlikeOptions::visit(OptionVisitor& v) {
  v("look_alike_starts", look_alike_starts, "",
    "maximum number of places tried around a verified registration, where the guess allows "
    "others; 0 tries none",
    {0, 100});
  v("look_alike_sigmas", look_alike_sigmas, "",
    "look-alikes are sought as if the guess's standard deviations were this many times larger, "
    "since odometry is often worse than it claims",
    kPositive);
}

std::vector<Pose3> lookAlikeStarts(const RegistrationResult& result, const Guess& guess,
                                   const PreparedScan& source, const PreparedScan& target,
                                   const LookAlikeOptions& options) {
  if (!guess.covariance) return {};
  const double reach = options.look_alike_sigmas * std::sqrt(chiSquareQuantile(kProbability, 2));
  const Matrix2d allowed = reach * reach * horizontalCovariance(guess);
  if (std::sqrt(largestEigenvalue(allowed)) < kStep_m) return {};
  const Vector2d from_guess =
      (result.target_T_source.translation() - guess.target_T_source.translation()).head<2>();
  std::vector<Pose3> starts;
  for (const Vector2d& shift :
       shiftsWithin(allowed, from_guess, resistance(target), options.look_alike_starts)) {
    const Pose3 start = Eigen::Translation3d(shift.x(), shift.y(), 0) * result.target_T_source;
    if (isAnotherAnswer(start, result) &&
        shareInFreeSpace(source, target, start, kMargin_m) < kMostInFreeSpace)
      starts.push_back(start);
  }
  return starts;
}

Fit fitOf(const PreparedScan& source, const PreparedScan& target, const Pose3& target_T_source) {
  const PatchEvidence of_source = patchEvidence(source, target, target_T_source);
  const PatchEvidence of_target = patchEvidence(target, source, target_T_source.inverse());
  return {static_cast<double>(of_source.agreeing.size() + of_target.agreeing.size()),
          static_cast<double>(of_source.contradicting.size() + of_target.contradicting.size()),
          agreement(source, target, target_T_source, kPartnerDistance_m).residual_m};
}

bool isAsGood(const Fit& other, const Fit& accepted) {
  // Some patches contradict even at the right pose; surfaces are rough, and seen at other points.
  constexpr double kLeastShare = 0.5, kFewestPatches = 3.0, kDeviations = 2.0, kRoughness_m = 0.05;
  const double chance = accepted.contradicting;
  return other.agreeing >= kLeastShare * accepted.agreeing &&
         other.contradicting < chance + kFewestPatches + kDeviations * std::sqrt(chance) &&
         other.residual_m < std::hypot(accepted.residual_m, kRoughness_m);
}

}  // namespace lamp
