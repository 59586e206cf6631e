#pragma once

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

/** The frame of every program: reads the command line, runs, and says on stderr what went wrong.
 * \return the exit code: 0; 1 if `run` threw; 2 for wrong use, UsageError or ConfigError. */
int runProgram(CLI::App& app, int argc, char** argv, const std::function<void()>& run);

}  // namespace lamp
