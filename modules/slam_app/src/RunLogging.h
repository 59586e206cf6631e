#pragma once

#include <mrpt/system/COutputLogger.h>

#include <iostream>
#include <map>
#include <string>

#include "lamp/slam_app/SlamRun.h"

namespace lamp {

inline const std::map<std::string, mrpt::system::VerbosityLevel> kLogLevels = {
    {"DEBUG", mrpt::system::LVL_DEBUG},
    {"INFO", mrpt::system::LVL_INFO},
    {"WARN", mrpt::system::LVL_WARN},
    {"ERROR", mrpt::system::LVL_ERROR}};

/** MRPT's loggers print warnings on stdout, which is for results. While it lives, stderr gets what
 * is written to stdout. */
class StdoutToStderr {
 public:
  StdoutToStderr() : stdout_(std::cout.rdbuf(std::cerr.rdbuf())) {}
  ~StdoutToStderr() { std::cout.rdbuf(stdout_); }
  StdoutToStderr(const StdoutToStderr&) = delete;
  StdoutToStderr& operator=(const StdoutToStderr&) = delete;

 private:
  std::streambuf* const stdout_;
};

inline SlamRun::Outcome runLogged(SlamRun& slam) {
  const StdoutToStderr logs;
  return slam.run();
}

/** \throws std::runtime_error if something is missing. */
inline void requireAllWritten(const SlamRun::Outcome& outcome, const std::string& out) {
  if (outcome.not_written.empty()) return;
  std::string text = "not everything could be written to '" + out + "':";
  for (const std::string& failure : outcome.not_written) text += "\n  " + failure;
  throw std::runtime_error(text);
}

}  // namespace lamp
