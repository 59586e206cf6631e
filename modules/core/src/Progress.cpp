#include "lamp/core/Progress.h"

#include <unistd.h>

#include <algorithm>
#include <iostream>

namespace lamp {

namespace {

constexpr auto kInterval = std::chrono::milliseconds(200);

std::string minutes(double seconds) {
  const int whole = static_cast<int>(seconds + 0.5);
  const std::string rest = std::to_string(whole % 60);
  return std::to_string(whole / 60) + ":" + (rest.size() == 1 ? "0" : "") + rest;
}

}  // namespace

Progress::Progress()
    : on_terminal_(::isatty(STDERR_FILENO) != 0), start_(Clock::now()), last_shown_(start_) {}

Progress::~Progress() {
  if (shown_) std::cerr << "\r\033[K" << std::flush;
}

bool Progress::due() const {
  return on_terminal_ && Clock::now() - last_shown_ >= kInterval;
}

void Progress::show(double share, const std::string& detail) {
  if (!due()) return;
  const auto now = last_shown_ = Clock::now();
  shown_ = true;
  const double elapsed = std::chrono::duration<double>(now - start_).count();
  std::string line = std::to_string(static_cast<int>(100.0 * share)) + " %";
  if (share > 0.01) line += ", " + minutes(elapsed * (1.0 - share) / share) + " left";
  std::cerr << "\r\033[K" << line << ", " << detail << std::flush;
}

}  // namespace lamp
