#pragma once

#include <cstddef>
#include <vector>

namespace lamp::evaluation {

/** Of a set of errors; all zero if it is empty. */
struct Statistics {
  size_t count = 0;
  double mean = 0, rmse = 0, std = 0, median = 0, p95 = 0, max = 0;

  static Statistics of(std::vector<double> values);
};

/** The value that the given share of the values does not exceed, interpolated between ranks.
 * \param sorted ascending, not empty. */
double quantile(const std::vector<double>& sorted, double share);

}  // namespace lamp::evaluation
