#pragma once

#include <atomic>
#include <functional>
#include <stdexcept>

namespace CLI {
class App;
}

namespace lamp {

/** The command line does not say what to do; the message tells what it should say. */
class UsageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/** What all programs do alike: read the command line, run, and say on stderr what went wrong.
 * SIGINT, SIGTERM and SIGHUP end the program and leave no half file.
 * \param end_early for programs that have something to show before their end: the first signal sets
 *    it, and only the second one ends the program.
 * \return the exit code: 0; 1 if `run` threw, or stdout cannot be written; 2 for wrong use,
 *    UsageError or ConfigError. */
int runProgram(CLI::App& app, int argc, char** argv, const std::function<void()>& run,
               std::atomic<bool>* end_early = nullptr);

}  // namespace lamp
