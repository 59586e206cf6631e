#pragma once

#include <string>
#include <vector>

namespace lamp {

/** When a robot's key nodes reach the base station over a radio link that breaks at times. All
 * times are seconds, UTC. */
class ArrivalTimes {
 public:
  struct Row {
    double stamp = 0;    ///< when it was recorded
    double arrival = 0;  ///< when it reaches the base station
  };

  /** A link that never breaks: what is recorded arrives at once. */
  ArrivalTimes() = default;
  /** \param rows with growing stamps, and arrivals that do not fall; see readArrivals(). */
  explicit ArrivalTimes(std::vector<Row> rows) : rows_(std::move(rows)) {}

  /** When what was recorded at `stamp` arrives: with the first row at or after it, and with the
   * last row beyond the end. Rows are written with microseconds, and compared so. */
  double at(double stamp) const;

 private:
  std::vector<Row> rows_;
};

/** Reads a CSV file with the columns `stamp` and `arrival`.
 *  \throws std::runtime_error with file and line if it cannot be read, has no row, a number is
 *  malformed or not finite, stamps do not grow, arrivals fall, or something arrives before its
 *  stamp. */
ArrivalTimes readArrivals(const std::string& path);

}  // namespace lamp
