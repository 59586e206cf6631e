#pragma once

#include <array>
#include <atomic>
#include <csignal>
#include <string>
#include <thread>

namespace lamp {

/** What SIGINT (Ctrl-C), SIGTERM (docker stop, systemd, timeout) and SIGHUP (the terminal is gone)
 * do while it lives: the first one asks the program to end early, if it can; the next one ends it
 * at once, and leaves no half file. A SIGHUP that `nohup` has ignored stays ignored. One object at
 * a time. */
class EndSignals {
 public:
  /** \param program for messages. \param end_early set by the first signal; null if the program
   * has no results that are usable before its end, so that the first signal ends it. */
  EndSignals(std::string program, std::atomic<bool>* end_early);
  ~EndSignals();
  EndSignals(const EndSignals&) = delete;
  EndSignals& operator=(const EndSignals&) = delete;

 private:
  /** Does on a thread of its own what a signal handler may not. */
  void watch();
  void onSignal(int signal);

  const std::string program_;
  std::atomic<bool>* const end_early_;
  std::array<int, 2> pipe_{};
  std::array<struct sigaction, 3> before_{};
  std::thread watch_;
};

}  // namespace lamp
