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

}  // namespace lamp
