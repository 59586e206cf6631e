#pragma once

#include <algorithm>
#include <deque>
#include <vector>

namespace lamp {

/** The time that a recording has reached: the lower median of the last stamps, so that single wrong
 * ones count for nothing. */
class RecentMedian {
 public:
  void add(double stamp) {
    recent_.push_back(stamp);
    if (recent_.size() > kSize) recent_.pop_front();
  }
  /** Only after a stamp was added. */
  double value() const {
    std::vector<double> sorted(recent_.begin(), recent_.end());
    const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>((sorted.size() - 1) / 2);
    std::nth_element(sorted.begin(), middle, sorted.end());
    return *middle;
  }

 private:
  static constexpr size_t kSize = 5;
  std::deque<double> recent_;
};

}  // namespace lamp
