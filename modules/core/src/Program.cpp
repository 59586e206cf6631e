#include "lamp/core/Program.h"

#include <CLI/CLI.hpp>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <iostream>

#include "EndSignals.h"
#include "lamp/core/Faults.h"

namespace lamp {

namespace {

/** Results that nobody got must not look like success. */
void checkOutput() {
  errno = 0;
  if (std::cout.flush() || errno == EPIPE) return;  // a reader like `head` has had enough
  throw std::runtime_error(std::string("cannot write to standard output: ") + std::strerror(errno));
}

}  // namespace

int runProgram(CLI::App& app, int argc, char** argv, const std::function<void()>& run,
               std::atomic<bool>* end_early) {
  constexpr int kOk = 0, kFailed = 1, kWrongUse = 2;
  const auto fail = [&](const std::string& message, int code) {
    std::cerr << app.get_name() << ": " << message << "\n";
    return code;
  };
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? kOk : kWrongUse;
  }
  // A message that nobody reads any more, as after `| tee` has gone, must not end the program.
  std::signal(SIGPIPE, SIG_IGN);
  try {
    const EndSignals signals(app.get_name(), end_early);
    run();
    checkOutput();
    return kOk;
  } catch (const UsageError& error) {
    return fail(error.what(), kWrongUse);
  } catch (const ConfigError& error) {
    return fail("the configuration has faults:\n" + std::string(error.what()), kWrongUse);
  } catch (const std::exception& error) {
    return fail(error.what(), kFailed);
  }
}

}  // namespace lamp
