#include "lamp/frontend/PriorWeight.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "lamp/core/Median.h"

namespace lamp {

namespace {

/** Innovations this much larger than they should be are a source's own error. */
constexpr double kExpectedSurprise = 1.5;
/** It is judged after so many scans. */
constexpr size_t kScans = 20;
constexpr double kMaxScale = 1e4;

}  // namespace

double Innovation::surprise() const {
  const auto freedom = static_cast<double>(Eigen::FullPivLU<Matrix6d>(expected).rank());
  return difference.dot(expected * difference) / std::max(1.0, freedom);
}

void PriorWeight::judge(const Innovation& innovation) {
  surprises_.push_back(innovation.surprise());
  sum_.difference += innovation.difference;
  sum_.expected += innovation.expected;
  if (surprises_.size() < kScans) return;
  const auto count = static_cast<double>(surprises_.size());
  const double together =
      Innovation{sum_.difference / std::sqrt(count), sum_.expected / count}.surprise();
  const double typical = std::max(medianOf(surprises_), together);
  surprises_.clear();
  sum_ = {};
  if (typical > kExpectedSurprise)
    scale_ = std::min(kMaxScale, scale_ * typical);
  else if (scale_ > 1)
    scale_ = std::max(1.0, scale_ * std::max(0.5, typical / kExpectedSurprise));
}

}  // namespace lamp
