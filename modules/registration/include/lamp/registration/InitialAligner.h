#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lamp/core/LoopClosure.h"
#include "lamp/core/Stage.h"
#include "lamp/scans/PreparedScan.h"

namespace lamp {

/** A relative pose for the refinement to start from. */
struct Hypothesis {
  Pose3 target_T_source = Pose3::Identity();
  size_t inliers = 0;       ///< matches that agree on it; 0 from aligners that match nothing
  double inlier_ratio = 0;  ///< of all matches
  /** How far points may lie from where they should, metres; none where the aligner cannot tell. */
  std::optional<double> accuracy_m;
};

/** Hypotheses, best first; if there are none, the reason why. */
struct AlignmentResult {
  std::vector<Hypothesis> hypotheses;
  std::string refusal;
};

/** First stage of the loop closure computation (paper II-C): a start for the refinement. */
class InitialAligner : public Stage {
  DEFINE_VIRTUAL_MRPT_OBJECT(InitialAligner)

 public:
  virtual AlignmentResult align(const PreparedScan& source, const PreparedScan& target,
                                const Guess& guess) const = 0;
};

}  // namespace lamp
