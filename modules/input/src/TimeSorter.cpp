#include "TimeSorter.h"

#include <algorithm>

namespace lamp {

TimeSorter::Key TimeSorter::push(const InputObservation& observation) {
  const Key key(observation.stamp, pushed_++);
  held_.emplace(key, observation);
  recent_.add(observation.stamp);
  time_ = time_ ? std::max(*time_, recent_.value()) : recent_.value();
  return key;
}

bool TimeSorter::ready() const {
  if (held_.empty()) return false;
  return closed_ || held_.size() > kMaxHeld || front().stamp + kWindow < *time_;
}

InputObservation TimeSorter::pop() {
  InputObservation first = front();
  held_.erase(held_.begin());
  return first;
}

}  // namespace lamp
