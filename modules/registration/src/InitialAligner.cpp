#include "lamp/registration/InitialAligner.h"

IMPLEMENTS_VIRTUAL_MRPT_OBJECT(InitialAligner, Stage, lamp)
IMPLEMENTS_MRPT_OBJECT(Identity, lamp::InitialAligner, lamp)
IMPLEMENTS_MRPT_OBJECT(Odometry, lamp::InitialAligner, lamp)
IMPLEMENTS_MRPT_OBJECT(OdometryRotation, lamp::InitialAligner, lamp)

namespace lamp {

AlignmentResult Identity::align(const PreparedScan&, const PreparedScan&, const Guess&) const {
  return {{Hypothesis{}}, ""};
}

AlignmentResult Odometry::align(const PreparedScan&, const PreparedScan&,
                                const Guess& guess) const {
  Hypothesis hypothesis;
  hypothesis.target_T_source = guess.target_T_source;
  return {{hypothesis}, ""};
}

AlignmentResult OdometryRotation::align(const PreparedScan&, const PreparedScan&,
                                        const Guess& guess) const {
  Hypothesis hypothesis;
  hypothesis.target_T_source.linear() = guess.target_T_source.linear();
  return {{hypothesis}, ""};
}

}  // namespace lamp
