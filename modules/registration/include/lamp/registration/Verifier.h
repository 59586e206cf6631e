#pragma once

#include <string>
#include <vector>

#include "lamp/core/LoopClosure.h"
#include "lamp/core/Stage.h"
#include "lamp/registration/Refiner.h"

namespace lamp {

/** A verdict with the figures that led to it. */
struct Verification {
  std::string refusal;  ///< empty: accepted
  std::vector<Score> scores;

  bool accepted() const { return refusal.empty(); }
};

/** Decides whether a registration is believable enough to become a loop closure. */
class Verifier : public Stage {
  DEFINE_VIRTUAL_MRPT_OBJECT(Verifier)

 public:
  virtual Verification verify(const RegistrationResult& result, const PreparedScan& source,
                              const PreparedScan& target, const Guess& guess) const = 0;
};

struct OverlapResidualOptions {
  double min_overlap = 0.6;
  double max_residual_m = 0.1;
  double partner_distance_m = 0.3;

  void visit(OptionVisitor& v);
};

/** Enough of the source must lie on the target, and close to it. */
class OverlapResidual : public Verifier {
  DEFINE_MRPT_OBJECT(OverlapResidual, lamp)

 public:
  OverlapResidualOptions options;
  void visit(OptionVisitor& v) override { options.visit(v); }
  Verification verify(const RegistrationResult& result, const PreparedScan& source,
                      const PreparedScan& target, const Guess& guess) const override;
};

struct GuessDeviationOptions {
  double probability = 0.9999;
  double slack_m = 0.3;
  double slack_deg = 5.0;

  void visit(OptionVisitor& v);
};

/** The result must not lie farther from the guess than the guess's own uncertainty allows: the
 * squared Mahalanobis distance stays below the χ² quantile. A slack keeps an overconfident graph
 * from refusing everything. */
class GuessDeviation : public Verifier {
  DEFINE_MRPT_OBJECT(GuessDeviation, lamp)

 public:
  GuessDeviationOptions options;
  void visit(OptionVisitor& v) override { options.visit(v); }
  Verification verify(const RegistrationResult& result, const PreparedScan& source,
                      const PreparedScan& target, const Guess& guess) const override;

 private:
  static double mahalanobis(const Vector6d& deviation, const Matrix6d& covariance,
                            const Matrix6d& information);
};

}  // namespace lamp
