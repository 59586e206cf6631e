#pragma once

#include <stdexcept>
#include <string>
#include <vector>

namespace lamp {

/** Wrong ini: carries every fault of a file at once. */
class ConfigError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/** Collects faults so that a user sees all of them in one go. */
class Faults {
 public:
  /** \param where `file:line`, or what else tells the user where to look. */
  void add(const std::string& where, const std::string& message);
  bool empty() const { return faults_.empty(); }
  const std::vector<std::string>& list() const { return faults_; }
  /** \throws ConfigError with one line a fault. */
  void throwIfAny() const;

 private:
  std::vector<std::string> faults_;
};

/** ` (did you mean 'x'?)` for the known word nearest to a misspelt one, or an empty string. */
std::string didYouMean(const std::string& word, const std::vector<std::string>& known);

}  // namespace lamp
