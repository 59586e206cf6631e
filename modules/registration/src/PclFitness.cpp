#include "lamp/registration/PclFitness.h"

#include <limits>

IMPLEMENTS_MRPT_OBJECT(PclFitness, lamp::Verifier, lamp)

namespace lamp {

namespace {

/** Mean squared distance of the source's points from their nearest target points, metres². Larger
 * than any threshold if there are no points. */
double fitness(const PreparedScan& source, const PreparedScan& target, const Pose3& pose) {
  constexpr double kWorst = std::numeric_limits<float>::max();
  constexpr float kAnyDistance = 1e6f;
  const Eigen::Isometry3f T = pose.cast<float>();
  double sum = 0;
  for (const uint32_t i : source.own()) {
    float squared = 0;
    if (target.tree().nearest(T * source.points()[i], kAnyDistance, squared) == KdTree::kNone)
      return kWorst;
    sum += squared;
  }
  return source.own().empty() ? kWorst : sum / static_cast<double>(source.own().size());
}

}  // namespace

void PclFitnessOptions::visit(OptionVisitor& v) {
  v("max_alignment_m2", max_alignment_m2, "m2",
    "maximum mean squared distance after the initial alignment", kPositive);
  v("max_refined_m2", max_refined_m2, "m2", "maximum mean squared distance after the refinement",
    kPositive);
}

Verification PclFitness::verify(const RegistrationResult& result, const PreparedScan& source,
                                const PreparedScan& target, const Guess&) const {
  Verification verification;
  const double alignment = fitness(source, target, result.start);
  const double refined = fitness(source, target, result.target_T_source);
  verification.scores = {{"alignment_fitness_m2", alignment, options.max_alignment_m2},
                         {"fitness_m2", refined, options.max_refined_m2}};
  if (!(alignment < options.max_alignment_m2))
    verification.refusal = "poor initial alignment";
  else if (!(refined < options.max_refined_m2))
    verification.refusal = "poor fitness";
  return verification;
}

}  // namespace lamp
