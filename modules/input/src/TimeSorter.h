#pragma once

#include <map>
#include <optional>
#include <utility>

#include "RecentMedian.h"
#include "lamp/input/ObservationSource.h"

namespace lamp {

/** Puts observations in order that a recording wrote late: sensors stamp the beginning of what they
 * measure and finish at different times. Equal stamps keep their order. */
class TimeSorter {
 public:
  static constexpr double kWindow = 1.0;    ///< seconds
  static constexpr size_t kMaxHeld = 2000;  ///< whatever their stamps

  /** Stamp, and number of the push. */
  using Key = std::pair<double, size_t>;

  Key push(const InputObservation& observation);
  /** What was pushed; null if it was popped already. */
  const InputObservation* find(const Key& key) const {
    const auto found = held_.find(key);
    return found == held_.end() ? nullptr : &found->second;
  }
  /** Takes back what was pushed and not popped yet. */
  void withdraw(const Key& key) { held_.erase(key); }
  /** No more observations will come. */
  void close() { closed_ = true; }
  /** True if no earlier observation than the first can come any more. */
  bool ready() const;
  const InputObservation& front() const { return held_.begin()->second; }
  InputObservation pop();

 private:
  std::map<Key, InputObservation> held_;
  RecentMedian recent_;
  std::optional<double> time_;  ///< that the recording has reached
  size_t pushed_ = 0;
  bool closed_ = false;
};

}  // namespace lamp
