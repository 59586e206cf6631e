#include "lamp/evaluation/LoopScore.h"

#include <Eigen/Eigenvalues>
#include <cmath>

namespace lamp::evaluation {

namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kDegree = M_PI / 180.0;
constexpr double kTrueOverlap = 0.3, kFalseOverlap = 0.05;
constexpr double kRightTranslation = 0.2, kRightRotation = 2 * kDegree;
constexpr double kWrongTranslation = 1.0, kWrongRotation = 5 * kDegree;
constexpr double kClaimedTranslation = 0.5, kClaimedRotation = 2 * kDegree;

/** The parts of an error in the directions that a closure claims to know. */
struct ClaimedError {
  double translation = 0, rotation = 0;
  bool any = false;
};

/** Length of the error's part in directions with a deviation below `claimed`. */
double claimedLength(const Vector3d& error, const Matrix3d& covariance, double claimed, bool& any) {
  const Eigen::SelfAdjointEigenSolver<Matrix3d> axes(covariance);
  double squared = 0;
  for (int i = 0; i < 3; ++i) {
    if (!(axes.eigenvalues()[i] < claimed * claimed)) continue;
    any = true;
    const double along = axes.eigenvectors().col(i).dot(error);
    squared += along * along;
  }
  return std::sqrt(squared);
}

/** Inverse of an information matrix that may be singular: huge variance where it knows nothing. */
Matrix6d covarianceOf(const Matrix6d& information) {
  constexpr double kNothing = 1e-9;
  const Eigen::SelfAdjointEigenSolver<Matrix6d> axes(information);
  const Vector6d variances = axes.eigenvalues().cwiseMax(kNothing).cwiseInverse();
  return axes.eigenvectors() * variances.asDiagonal() * axes.eigenvectors().transpose();
}

ClaimedError claimedError(const Pose3& error, const std::optional<Matrix6d>& information) {
  const Vector6d e = logSE3(error);
  if (!information) return {error.translation().norm(), rotationAngle(error), true};
  const Matrix6d covariance = covarianceOf(*information);
  ClaimedError claimed;
  claimed.translation = claimedLength(error.translation(), covariance.topLeftCorner<3, 3>(),
                                      kClaimedTranslation, claimed.any);
  claimed.rotation = claimedLength(e.tail<3>(), covariance.bottomRightCorner<3, 3>(),
                                   kClaimedRotation, claimed.any);
  return claimed;
}

void count(const JudgedLoop& judged, StageScore& stage) {
  ++stage.accepted;
  if (judged.pair == PairKind::kTrue) ++stage.true_pairs;
  if (judged.pair == PairKind::kFalse) ++stage.false_pairs;
  if (judged.pair == PairKind::kBetween) ++stage.between_pairs;
  if (judged.pair == PairKind::kUnknown) ++stage.unknown_pairs;
  if (!judged.error) {
    ++stage.not_judged;
    return;
  }
  const bool right = judged.closure == ClosureKind::kRight;
  const bool wrong = judged.closure == ClosureKind::kWrong;
  ++(right ? stage.right : wrong ? stage.wrong : stage.neither);
  if (right && judged.pair == PairKind::kTrue) ++stage.right_of_true_pairs;
}

std::optional<double> ratio(size_t part, size_t whole) {
  if (whole == 0) return std::nullopt;
  return static_cast<double>(part) / static_cast<double>(whole);
}

}  // namespace

PairKind pairKind(double overlap) {
  if (overlap >= kTrueOverlap) return PairKind::kTrue;
  return overlap < kFalseOverlap ? PairKind::kFalse : PairKind::kBetween;
}

ClosureKind closureKind(const Pose3& error, const std::optional<Matrix6d>& information) {
  const ClaimedError e = claimedError(error, information);
  if (!e.any) return ClosureKind::kNeither;
  if (e.translation > kWrongTranslation || e.rotation > kWrongRotation) return ClosureKind::kWrong;
  return e.translation <= kRightTranslation && e.rotation <= kRightRotation ? ClosureKind::kRight
                                                                            : ClosureKind::kNeither;
}

std::optional<double> LoopScore::precision(const StageScore& stage) {
  return ratio(stage.right, stage.right + stage.wrong);
}
std::optional<double> LoopScore::recall(const StageScore& stage) const {
  return ratio(stage.right_of_true_pairs, generated.true_pairs);
}
std::optional<double> LoopScore::recallOfPairs(const StageScore& stage) const {
  return ratio(stage.true_pairs, generated.true_pairs);
}
std::optional<double> LoopScore::falsePositives(const StageScore& stage) const {
  return ratio(stage.false_pairs, generated.false_pairs);
}

LoopScore scoreLoops(const std::vector<const JudgedLoop*>& loops) {
  LoopScore score;
  std::vector<double> translations, rotations;
  std::vector<ClaimedPose> claimed;
  for (const JudgedLoop* judged : loops) {
    count(*judged, score.generated);
    if (judged->loop.verified) count(*judged, score.verified);
    if (!judged->loop.kept) continue;
    count(*judged, score.kept);
    if (!judged->error) continue;
    translations.push_back(judged->error->translation().norm());
    rotations.push_back(rotationAngle(*judged->error) / kDegree);
    if (judged->closure == ClosureKind::kRight && judged->loop.information)
      claimed.push_back({*judged->error, *judged->loop.information});
  }
  score.translation_m = Statistics::of(translations);
  score.rotation_deg = Statistics::of(rotations);
  score.covariance = scoreCovariances(claimed);
  return score;
}

}  // namespace lamp::evaluation
