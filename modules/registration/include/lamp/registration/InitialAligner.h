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

/** Hypotheses, best first; none with the reason why. */
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

/** Starts with both key nodes at the same place, looking the same way. */
class Identity : public InitialAligner {
  DEFINE_MRPT_OBJECT(Identity, lamp)

 public:
  void visit(OptionVisitor&) override {}
  AlignmentResult align(const PreparedScan& source, const PreparedScan& target,
                        const Guess& guess) const override;
};

/** Starts from the graph's current estimate of the relative pose. */
class Odometry : public InitialAligner {
  DEFINE_MRPT_OBJECT(Odometry, lamp)

 public:
  void visit(OptionVisitor&) override {}
  AlignmentResult align(const PreparedScan& source, const PreparedScan& target,
                        const Guess& guess) const override;
};

/** Starts at the same place, with the graph's current estimate of the rotation (LAMP 1.0). */
class OdometryRotation : public InitialAligner {
  DEFINE_MRPT_OBJECT(OdometryRotation, lamp)

 public:
  void visit(OptionVisitor&) override {}
  AlignmentResult align(const PreparedScan& source, const PreparedScan& target,
                        const Guess& guess) const override;
};

}  // namespace lamp
