#include "lamp/evaluation/Statistics.h"

#include <algorithm>
#include <cmath>

namespace lamp::evaluation {

double quantile(const std::vector<double>& sorted, double share) {
  const double place = share * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<size_t>(place);
  const size_t above = std::min(below + 1, sorted.size() - 1);
  return sorted[below] + (place - static_cast<double>(below)) * (sorted[above] - sorted[below]);
}

Statistics Statistics::of(std::vector<double> values) {
  Statistics result;
  if (values.empty()) return result;
  std::sort(values.begin(), values.end());
  result.count = values.size();
  const auto n = static_cast<double>(values.size());
  double squares = 0, deviations = 0;
  for (const double value : values) {
    result.mean += value / n;
    squares += value * value;
  }
  for (const double value : values) deviations += (value - result.mean) * (value - result.mean);
  result.rmse = std::sqrt(squares / n);
  result.std = std::sqrt(deviations / n);
  result.median = quantile(values, 0.5);
  result.p95 = quantile(values, 0.95);
  result.max = values.back();
  return result;
}

}  // namespace lamp::evaluation
