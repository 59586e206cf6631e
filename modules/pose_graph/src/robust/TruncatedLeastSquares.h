#pragma once

#include "robust/Graduation.h"

namespace lamp {

/** The surrogate of the truncated least-squares cost in Yang et al., RA-L 2020. Convex for mu near
 * 0, exact as mu goes to infinity. */
class TruncatedLeastSquares : public Graduation {
 public:
  /** Makes the surrogate convex over all residuals (their remark 5). */
  void start(double largest) override { mu_ = 1.0 / (2.0 * largest - 1.0); }
  /** Closed-form weight (their eq. 14). */
  double weight(double residual2) const override;
  void sharpen(double step) override { mu_ *= step; }
  /** Whether no residual lies between the sure inliers and the sure outliers. */
  bool exactFor(const std::vector<double>& residuals2) const override;
  bool sharp() const override { return mu_ >= 10.0; }

 private:
  double inlierLimit() const { return mu_ / (mu_ + 1.0); }
  double outlierLimit() const { return (mu_ + 1.0) / mu_; }

  double mu_ = 1.0;
};

}  // namespace lamp
