#pragma once

#include "robust/Graduation.h"

namespace lamp {

/** The surrogate of the Geman-McClure cost in Yang et al., RA-L 2020. Convex as mu goes to
 * infinity, exact for mu = 1. */
class GemanMcClure : public Graduation {
 public:
  /** Makes the surrogate convex over all residuals (their remark 5). */
  void start(double largest) override { mu_ = 2.0 * largest; }
  /** Closed-form weight (their eq. 12). */
  double weight(double residual2) const override;
  void sharpen(double step) override;
  bool exactFor(const std::vector<double>&) const override { return mu_ <= 1.0; }
  bool sharp() const override { return mu_ <= 1.0; }

 private:
  double mu_ = 1.0;
};

}  // namespace lamp
