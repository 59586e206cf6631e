#pragma once

#include <optional>
#include <vector>

#include "lamp/evaluation/CovarianceScore.h"
#include "lamp/evaluation/LedgerLoops.h"
#include "lamp/evaluation/Statistics.h"

namespace lamp::evaluation {

/** Whether two key nodes see the same place, by the overlap of their scans at the true poses. */
enum class PairKind {
  kTrue,     ///< overlap of 0.3 at least
  kFalse,    ///< overlap below 0.05
  kBetween,  ///< not scored
  kUnknown   ///< no true pose, or no scan
};
PairKind pairKind(double overlap);

/** How near a loop closure comes to the truth. */
enum class ClosureKind { kRight, kWrong, kNeither };

/** Right within 0.2 m and 2°, wrong beyond 1 m or 5°. With an information matrix only directions
 * count in which the closure claims a standard deviation below 0.5 m, or 2°; a closure that claims
 * none is neither.
 * \param error from_T_to⁻¹ (true) · from_T_to (estimated). */
ClosureKind closureKind(const Pose3& error, const std::optional<Matrix6d>& information);

/** A pair of key nodes that was tried, with the truth about it. */
struct JudgedLoop {
  LedgerLoop loop;
  PairKind pair = PairKind::kUnknown;
  std::optional<Pose3> error;  ///< none without true poses, or without a result
  ClosureKind closure = ClosureKind::kNeither;
};

/** Counts at one stage: of the pairs that came so far, "accepted". */
struct StageScore {
  size_t accepted = 0;
  size_t right = 0, wrong = 0, neither = 0, not_judged = 0;
  size_t true_pairs = 0, false_pairs = 0, between_pairs = 0, unknown_pairs = 0;
  size_t right_of_true_pairs = 0;
};

/** The stages over one set of pairs. */
struct LoopScore {
  StageScore generated, verified, kept;
  Statistics translation_m, rotation_deg;  ///< errors of the kept loops, in all directions
  CovarianceScore covariance;              ///< of the kept loops that are right

  /** right / (right + wrong); none if there are none. */
  static std::optional<double> precision(const StageScore& stage);
  /** Right and accepted, of the true pairs that were generated. */
  std::optional<double> recall(const StageScore& stage) const;
  /** The paper's recall, which ignores the error of the pose: accepted true pairs / true pairs. */
  std::optional<double> recallOfPairs(const StageScore& stage) const;
  /** F/P: accepted false pairs / false pairs. */
  std::optional<double> falsePositives(const StageScore& stage) const;
};

LoopScore scoreLoops(const std::vector<const JudgedLoop*>& loops);

}  // namespace lamp::evaluation
