#include "TimeSorter.h"

#include <algorithm>

namespace lamp {

void TimeSorter::push(const InputObservation& observation) {
  newest_ = pushed_ == 0 ? observation.stamp : std::max(newest_, observation.stamp);
  held_.push({observation, pushed_++});
}

bool TimeSorter::ready() const {
  if (held_.empty()) return false;
  return closed_ || held_.size() > kMaxHeld || held_.top().observation.stamp + kWindow < newest_;
}

InputObservation TimeSorter::pop() {
  InputObservation first = held_.top().observation;
  held_.pop();
  return first;
}

}  // namespace lamp
