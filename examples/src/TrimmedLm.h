#pragma once

#include <lamp/pose_graph/PlainOptimizers.h>

namespace lamp {

struct TrimmedLmOptions {
  double inlier_probability = 0.9999;
  int max_rounds = 20;

  void visit(OptionVisitor& v);
};

/** Least squares by Lm; loop closures that do not fit the result are left out, and all is solved
 * again, until the loops that take part are those that fit. */
class TrimmedLm : public Optimizer {
  DEFINE_MRPT_OBJECT(TrimmedLm, lamp)

 public:
  using Optimizer::optimize;
  void visit(OptionVisitor& v) override;
  OptimizationResult optimize(const PoseGraph& graph, const std::vector<bool>& admitted) override;

 private:
  TrimmedLmOptions options_;
  Lm solver_;
};

}  // namespace lamp
