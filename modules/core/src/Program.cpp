#include "lamp/core/Program.h"

#include <CLI/CLI.hpp>
#include <iostream>

#include "lamp/core/Faults.h"

namespace lamp {

int runProgram(CLI::App& app, int argc, char** argv, const std::function<void()>& run) {
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
  try {
    run();
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
