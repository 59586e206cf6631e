#include "lamp/transport/ArrivalTimes.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "lamp/core/Csv.h"

namespace lamp {

namespace {

/** Half a microsecond is lost by writing 6 decimals; doubles of our days resolve a quarter. */
constexpr double kStampTolerance = 1e-6;

double numberIn(const std::string& cell, const std::string& column, const std::string& where) {
  double number = 0;
  if (parseDouble(cell, number) && std::isfinite(number)) return number;
  throw std::runtime_error(where + ": " + column + " '" + cell + "' is not a finite number");
}

void checkRow(const ArrivalTimes::Row& row, const ArrivalTimes::Row* before,
              const std::string& where) {
  const auto fail = [&](double value, const std::string& what, double other) {
    throw std::runtime_error(where + ": " + formatFixed(value, 6) + what + formatFixed(other, 6));
  };
  if (row.arrival < row.stamp) fail(row.arrival, " is an arrival before its stamp ", row.stamp);
  if (!before) return;
  if (row.stamp <= before->stamp)
    fail(row.stamp, " is not later than the stamp above, ", before->stamp);
  if (row.arrival < before->arrival)
    fail(row.arrival, " is an arrival before the one above, ", before->arrival);
}

}  // namespace

double ArrivalTimes::at(double stamp) const {
  if (rows_.empty()) return stamp;
  const auto found = std::lower_bound(rows_.begin(), rows_.end(), stamp - kStampTolerance,
                                      [](const Row& row, double t) { return row.stamp < t; });
  return found == rows_.end() ? rows_.back().arrival : found->arrival;
}

ArrivalTimes readArrivals(const std::string& path) {
  const CsvTable table = CsvTable::fromFile(path);
  if (!table.has("stamp") || !table.has("arrival"))
    throw std::runtime_error(path + ":1: the header must name the columns stamp and arrival");
  if (table.rows.empty()) throw std::runtime_error(path + ": holds no arrival");
  const size_t stamp = table.column("stamp"), arrival = table.column("arrival");
  std::vector<ArrivalTimes::Row> rows;
  for (const auto& cells : table.rows) {
    const std::string where = path + ":" + std::to_string(rows.size() + 2);
    const ArrivalTimes::Row row{numberIn(cells[stamp], "stamp", where),
                                numberIn(cells[arrival], "arrival", where)};
    checkRow(row, rows.empty() ? nullptr : &rows.back(), where);
    rows.push_back(row);
  }
  return ArrivalTimes(std::move(rows));
}

}  // namespace lamp
