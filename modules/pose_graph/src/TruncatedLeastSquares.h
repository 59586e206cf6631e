#pragma once

namespace lamp {

/** The surrogate of the truncated least-squares cost in Yang et al., RA-L 2020, with c² the largest
 * squared residual of an inlier. Convex for mu near 0, exact for mu to infinity. */
struct TruncatedLeastSquares {
  double c2;

  /** Where to start so that the surrogate is convex over all residuals (their remark 5). To be
   * asked only if max_chi2 > c2. */
  double initialMu(double max_chi2) const { return c2 / (2.0 * max_chi2 - c2); }
  /** Residuals up to here have weight 1. */
  double inlierLimit(double mu) const { return mu / (mu + 1.0) * c2; }
  /** Residuals from here on have weight 0. */
  double outlierLimit(double mu) const { return (mu + 1.0) / mu * c2; }
  /** Closed-form weight (their eq. 14). */
  double weight(double chi2, double mu) const;
};

}  // namespace lamp
