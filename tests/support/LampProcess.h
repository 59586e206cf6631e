#pragma once

#include <sys/types.h>

#include <string>
#include <vector>

#include "TemporaryFolder.h"

namespace lamp::test {

/** How a run of one of our programs ended. */
struct LampResult {
  int exit_code = -1;  ///< -1 if a signal ended it
  int signal = 0;      ///< that ended it
  std::string out, err;
};

/** One of the real programs, running. */
class LampProcess {
 public:
  LampProcess(const std::string& program, const std::vector<std::string>& arguments);
  /** lamp-slam. */
  explicit LampProcess(const std::vector<std::string>& arguments);
  /** Kills it if nobody has waited for it. */
  ~LampProcess();
  LampProcess(const LampProcess&) = delete;
  LampProcess& operator=(const LampProcess&) = delete;

  void signal(int number) const;
  bool isRunning();
  LampResult wait();

 private:
  TemporaryFolder outputs_;
  pid_t pid_ = 0;
  int status_ = 0;
};

/** Runs lamp-slam to its end. */
LampResult runLamp(const std::vector<std::string>& arguments);
/** Runs lamp-register to its end. */
LampResult runRegister(const std::vector<std::string>& arguments);
/** Runs lamp-odometry to its end. */
LampResult runOdometry(const std::vector<std::string>& arguments);
/** Runs lamp-localize to its end. */
LampResult runLocalize(const std::vector<std::string>& arguments);
/** Runs lamp-sim to its end. */
LampResult runSimulator(const std::vector<std::string>& arguments);

}  // namespace lamp::test
