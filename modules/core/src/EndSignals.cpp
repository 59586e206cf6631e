#include "EndSignals.h"

#include <fcntl.h>
#include <string.h>
#include <unistd.h>

#include <cerrno>
#include <iostream>
#include <system_error>
#include <utility>

#include "lamp/core/Files.h"

namespace lamp {

namespace {

constexpr std::array<int, 3> kSignals = {SIGINT, SIGTERM, SIGHUP};
constexpr unsigned char kStop = 0;

std::atomic<int> handler_pipe{-1};

void passOn(int signal) {
  const int error = errno;
  const auto number = static_cast<unsigned char>(signal);
  [[maybe_unused]] const ssize_t written = ::write(handler_pipe, &number, 1);
  errno = error;
}

}  // namespace

EndSignals::EndSignals(std::string program, std::atomic<bool>* end_early)
    : program_(std::move(program)), end_early_(end_early) {
  if (::pipe2(pipe_.data(), O_CLOEXEC) != 0)
    throw std::system_error(errno, std::generic_category(), "cannot prepare for Ctrl-C");
  handler_pipe = pipe_[1];
  watch_ = std::thread([this] { watch(); });
  struct sigaction action {};
  action.sa_handler = passOn;
  action.sa_flags = SA_RESTART;
  for (size_t i = 0; i < kSignals.size(); ++i) {
    ::sigaction(kSignals[i], nullptr, &before_[i]);
    const bool ignored = before_[i].sa_handler == SIG_IGN;
    if (kSignals[i] != SIGHUP || !ignored) ::sigaction(kSignals[i], &action, nullptr);
  }
}

EndSignals::~EndSignals() {
  for (size_t i = 0; i < kSignals.size(); ++i) ::sigaction(kSignals[i], &before_[i], nullptr);
  [[maybe_unused]] const ssize_t written = ::write(pipe_[1], &kStop, 1);
  watch_.join();
  handler_pipe = -1;
  for (const int end : pipe_) ::close(end);
}

void EndSignals::watch() {
  unsigned char number = kStop;
  while (::read(pipe_[0], &number, 1) == 1 && number != kStop) onSignal(number);
}

void EndSignals::onSignal(int signal) {
  const std::string name = std::string("SIG") + ::sigabbrev_np(signal);
  if (end_early_ && !end_early_->exchange(true)) {
    std::cerr << program_ << ": " << name
              << ": ending early with what there is; a second signal ends at once\n";
    return;
  }
  std::cerr << program_ << ": ended by " << name << "\n";
  removeUnfinishedFiles();
  ::signal(signal, SIG_DFL);
  ::raise(signal);
}

}  // namespace lamp
