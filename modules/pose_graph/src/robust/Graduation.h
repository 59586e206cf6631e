#pragma once

#include <vector>

namespace lamp {

/** A family of cost functions from convex to robust, steered by the control parameter mu of
 * graduated non-convexity (Yang, Antonante, Tzoumas, Carlone, RA-L 2020). Squared residuals are in
 * units of the largest that an inlier may have, the paper's c². */
class Graduation {
 public:
  virtual ~Graduation() = default;

  /** Sets mu so that the cost is convex. \param largest squared residual, above 1. */
  virtual void start(double largest) = 0;
  /** 0..1; 0 for NaN. */
  virtual double weight(double residual2) const = 0;
  /** Moves mu by the factor `step`, above 1, towards the robust cost. */
  virtual void sharpen(double step) = 0;
  /** Whether the cost is already the robust one for these residuals. */
  virtual bool exactFor(const std::vector<double>& residuals2) const = 0;
  /** Whether the cost is the robust one for all residuals but those within a tenth of the
   * threshold. */
  virtual bool sharp() const = 0;
};

}  // namespace lamp
