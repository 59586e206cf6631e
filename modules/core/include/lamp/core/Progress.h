#pragma once

#include <chrono>
#include <string>

namespace lamp {

/** One line on a terminal that says how far a long work is; silent where nobody watches. */
class Progress {
 public:
  Progress();
  /** Removes the line, so that other text can follow. */
  ~Progress();
  /** Whether show() would show anything now: for details that are costly to tell. */
  bool due() const;
  /** \param share of the work done, 0 to 1; \param detail shown behind the time left. */
  void show(double share, const std::string& detail);

 private:
  using Clock = std::chrono::steady_clock;
  const bool on_terminal_;
  const Clock::time_point start_;
  Clock::time_point last_shown_;
  bool shown_ = false;
};

}  // namespace lamp
