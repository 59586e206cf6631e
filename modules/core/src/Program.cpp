#include "lamp/core/Program.h"

#include <CLI/CLI.hpp>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <iostream>
#include <new>
#include <system_error>

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

/** What std::thread throws where the system refuses one more says nothing of threads. */
std::string describe(const std::system_error& error) {
  if (error.code() != std::errc::resource_unavailable_try_again) return error.what();
  return "the system refuses to start a thread: memory or the number of processes is limited; see "
         "`ulimit -v` and `ulimit -u`";
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
  } catch (const std::bad_alloc&) {
    return fail("not enough memory; if `ulimit -v` shows a limit, raise it", kFailed);
  } catch (const std::system_error& error) {
    return fail(describe(error), kFailed);
  } catch (const std::exception& error) {
    return fail(error.what(), kFailed);
  }
}

}  // namespace lamp
