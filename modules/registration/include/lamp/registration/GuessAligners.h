#pragma once

#include "lamp/registration/InitialAligner.h"

namespace lamp {

/** Starts with both key nodes at the same place, looking the same way. */
class IdentityGuess : public InitialAligner {
  DEFINE_MRPT_OBJECT(IdentityGuess, lamp)

 public:
  void visit(OptionVisitor&) override {}
  AlignmentResult align(const PreparedScan& source, const PreparedScan& target,
                        const Guess& guess) const override;
};

/** Starts from the graph's current estimate of the relative pose. */
class OdometryGuess : public InitialAligner {
  DEFINE_MRPT_OBJECT(OdometryGuess, lamp)

 public:
  void visit(OptionVisitor&) override {}
  AlignmentResult align(const PreparedScan& source, const PreparedScan& target,
                        const Guess& guess) const override;
};

/** Starts at the same place, with the graph's current estimate of the rotation (LAMP 1.0). */
class OdometryRotationGuess : public InitialAligner {
  DEFINE_MRPT_OBJECT(OdometryRotationGuess, lamp)

 public:
  void visit(OptionVisitor&) override {}
  AlignmentResult align(const PreparedScan& source, const PreparedScan& target,
                        const Guess& guess) const override;
};

}  // namespace lamp
