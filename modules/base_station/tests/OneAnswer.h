#pragma once

#include <memory>

#include "TestTeam.h"

namespace lamp {

/** Knows one answer, for sources of 12 points: 16 m ahead. */
class OneAnswer : public Refiner {
  DEFINE_MRPT_OBJECT(OneAnswer, lamp)
 public:
  void visit(OptionVisitor&) override {}
  RegistrationResult refine(const PreparedScan& source, const PreparedScan&,
                            const Hypothesis& hypothesis) const override {
    RegistrationResult result;
    result.target_T_source = hypothesis.target_T_source;
    if (source.own().size() != 12) return result;
    result.converged = true;
    result.target_T_source = planarPose(16, 0, 0);
    result.information = Matrix6d::Identity() / variance;
    return result;
  }
  double variance = 1e-6;
};

/** The config's computation with another refiner. */
inline LoopClosureComputation computationWith(const SlamConfig& config,
                                              std::shared_ptr<const Refiner> refiner) {
  const auto aligners = config.make<InitialAligner>();
  const auto verifiers = config.make<Verifier>();
  return {{aligners.begin(), aligners.end()},
          std::move(refiner),
          {verifiers.begin(), verifiers.end()},
          config.registration.ambiguity};
}

}  // namespace lamp
