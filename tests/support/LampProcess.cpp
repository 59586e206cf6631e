#include "LampProcess.h"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstring>
#include <fstream>
#include <iterator>

namespace lamp::test {

namespace {

std::string textOf(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

/** Where the three standard streams of the program come from and go to. */
class Redirection {
 public:
  explicit Redirection(const TemporaryFolder& outputs) {
    constexpr int kWrite = O_WRONLY | O_CREAT | O_TRUNC;
    ::posix_spawn_file_actions_init(&actions_);
    ::posix_spawn_file_actions_addopen(&actions_, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    ::posix_spawn_file_actions_addopen(&actions_, STDOUT_FILENO, (outputs / "out").c_str(), kWrite,
                                       0600);
    ::posix_spawn_file_actions_addopen(&actions_, STDERR_FILENO, (outputs / "err").c_str(), kWrite,
                                       0600);
  }
  ~Redirection() { ::posix_spawn_file_actions_destroy(&actions_); }
  Redirection(const Redirection&) = delete;
  Redirection& operator=(const Redirection&) = delete;
  const posix_spawn_file_actions_t* get() const { return &actions_; }

 private:
  posix_spawn_file_actions_t actions_;
};

}  // namespace

LampProcess::LampProcess(const std::string& program, const std::vector<std::string>& arguments) {
  std::vector<std::string> words = {program};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  const int error = ::posix_spawn(&pid_, program.c_str(), Redirection(outputs_).get(), nullptr,
                                  argv.data(), environ);
  if (error != 0) throw std::runtime_error("cannot run " + program + ": " + std::strerror(error));
}

LampProcess::LampProcess(const std::vector<std::string>& arguments)
    : LampProcess(LAMP_SLAM, arguments) {}

LampProcess::~LampProcess() {
  if (!isRunning()) return;
  ::kill(pid_, SIGKILL);
  ::waitpid(pid_, &status_, 0);
}

void LampProcess::signal(int number) const {
  ::kill(pid_, number);
}

bool LampProcess::isRunning() {
  if (pid_ != 0 && ::waitpid(pid_, &status_, WNOHANG) == pid_) pid_ = 0;
  return pid_ != 0;
}

LampResult LampProcess::wait() {
  if (pid_ != 0) ::waitpid(pid_, &status_, 0);
  pid_ = 0;
  LampResult result;
  if (WIFEXITED(status_)) result.exit_code = WEXITSTATUS(status_);
  if (WIFSIGNALED(status_)) result.signal = WTERMSIG(status_);
  result.out = textOf(outputs_ / "out");
  result.err = textOf(outputs_ / "err");
  return result;
}

LampResult runLamp(const std::vector<std::string>& arguments) {
  return LampProcess(arguments).wait();
}

LampResult runRegister(const std::vector<std::string>& arguments) {
  return LampProcess(LAMP_REGISTER, arguments).wait();
}

LampResult runOdometry(const std::vector<std::string>& arguments) {
  return LampProcess(LAMP_ODOMETRY, arguments).wait();
}

LampResult runLocalize(const std::vector<std::string>& arguments) {
  return LampProcess(LAMP_LOCALIZE, arguments).wait();
}

LampResult runSimulator(const std::vector<std::string>& arguments) {
  return LampProcess(LAMP_SIM, arguments).wait();
}

}  // namespace lamp::test
