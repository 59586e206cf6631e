#include "TruncatedLeastSquares.h"

#include <cmath>

namespace lamp {

double TruncatedLeastSquares::weight(double chi2, double mu) const {
  if (chi2 <= inlierLimit(mu)) return 1.0;
  if (!(chi2 < outlierLimit(mu))) return 0.0;
  return std::sqrt(c2 / chi2 * mu * (mu + 1.0)) - mu;
}

}  // namespace lamp
