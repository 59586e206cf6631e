#include "robust/GemanMcClure.h"

#include <algorithm>

namespace lamp {

namespace {

/** Weights below this count as zero: the cost never quite gives up an edge, but each one takes time
 * for its fill-in. */
constexpr double kLeastWeight = 1e-4;

}  // namespace

double GemanMcClure::weight(double residual2) const {
  const double share = mu_ / (residual2 + mu_), weight = share * share;
  return weight >= kLeastWeight ? weight : 0.0;
}

void GemanMcClure::sharpen(double step) {
  mu_ = std::max(1.0, mu_ / step);
}

}  // namespace lamp
