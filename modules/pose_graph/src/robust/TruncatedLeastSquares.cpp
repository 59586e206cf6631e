#include "robust/TruncatedLeastSquares.h"

#include <algorithm>
#include <cmath>

namespace lamp {

double TruncatedLeastSquares::weight(double residual2) const {
  if (residual2 <= inlierLimit()) return 1.0;
  if (!(residual2 < outlierLimit())) return 0.0;
  return std::sqrt(mu_ * (mu_ + 1.0) / residual2) - mu_;
}

bool TruncatedLeastSquares::exactFor(const std::vector<double>& residuals2) const {
  return std::none_of(residuals2.begin(), residuals2.end(), [&](double residual2) {
    return residual2 > inlierLimit() && residual2 < outlierLimit();
  });
}

}  // namespace lamp
