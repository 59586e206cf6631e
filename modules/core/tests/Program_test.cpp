#include "lamp/core/Program.h"

#include <gmock/gmock.h>

#include <CLI/CLI.hpp>
#include <new>
#include <system_error>

using namespace lamp;
using testing::HasSubstr;

namespace {

/** What a program that fails so says on standard error. It must end with code 1. */
std::string complaintOf(const std::function<void()>& run) {
  char name[] = "program";
  char* arguments[] = {name};
  CLI::App app("", name);
  testing::internal::CaptureStderr();
  EXPECT_EQ(runProgram(app, 1, arguments, run), 1);
  return testing::internal::GetCapturedStderr();
}

}  // namespace

TEST(Program, SaysWhatToDoWithoutMemory) {
  EXPECT_THAT(complaintOf([] { throw std::bad_alloc(); }), HasSubstr("ulimit -v"));
}

TEST(Program, SaysWhatToDoWithoutThreads) {
  const auto refused = std::make_error_code(std::errc::resource_unavailable_try_again);
  EXPECT_THAT(complaintOf([&] { throw std::system_error(refused); }), HasSubstr("start a thread"));
}

TEST(Program, OtherErrorsOfTheSystemSpeakForThemselves) {
  const auto denied = std::make_error_code(std::errc::permission_denied);
  EXPECT_EQ(complaintOf([&] { throw std::system_error(denied, "cannot look"); }),
            "program: cannot look: Permission denied\n");
}
