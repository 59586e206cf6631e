#include "lamp/registration/GuessAligners.h"

IMPLEMENTS_MRPT_OBJECT(IdentityGuess, lamp::InitialAligner, lamp)
IMPLEMENTS_MRPT_OBJECT(OdometryGuess, lamp::InitialAligner, lamp)
IMPLEMENTS_MRPT_OBJECT(OdometryRotationGuess, lamp::InitialAligner, lamp)

namespace lamp {

AlignmentResult IdentityGuess::align(const PreparedScan&, const PreparedScan&, const Guess&) const {
  return {{Hypothesis{}}, ""};
}

AlignmentResult OdometryGuess::align(const PreparedScan&, const PreparedScan&,
                                     const Guess& guess) const {
  Hypothesis hypothesis;
  hypothesis.target_T_source = guess.target_T_source;
  return {{hypothesis}, ""};
}

AlignmentResult OdometryRotationGuess::align(const PreparedScan&, const PreparedScan&,
                                             const Guess& guess) const {
  Hypothesis hypothesis;
  hypothesis.target_T_source.linear() = guess.target_T_source.linear();
  return {{hypothesis}, ""};
}

}  // namespace lamp
