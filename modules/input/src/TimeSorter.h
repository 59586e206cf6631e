#pragma once

#include <queue>
#include <vector>

#include "lamp/input/ObservationSource.h"

namespace lamp {

/** Puts observations in order that a recording wrote late: sensors stamp the beginning of what they
 * measure and finish at different times. Equal stamps keep their order. */
class TimeSorter {
 public:
  static constexpr double kWindow = 1.0;    ///< seconds
  static constexpr size_t kMaxHeld = 2000;  ///< whatever their stamps

  void push(const InputObservation& observation);
  /** No more observations will come. */
  void close() { closed_ = true; }
  /** True if no earlier observation than the first can come any more. */
  bool ready() const;
  const InputObservation& front() const { return held_.top().observation; }
  InputObservation pop();

 private:
  struct Entry {
    InputObservation observation;
    size_t number;
  };
  struct Later {
    bool operator()(const Entry& a, const Entry& b) const {
      if (a.observation.stamp != b.observation.stamp) {
        return a.observation.stamp > b.observation.stamp;
      }
      return a.number > b.number;
    }
  };

  std::priority_queue<Entry, std::vector<Entry>, Later> held_;
  double newest_ = 0;
  size_t pushed_ = 0;
  bool closed_ = false;
};

}  // namespace lamp
