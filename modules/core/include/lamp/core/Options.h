#pragma once

#include <limits>
#include <string>
#include <vector>

namespace lamp {

/** Closed interval that an option's value (or each of its values) must lie in. */
struct Range {
  double min = -std::numeric_limits<double>::infinity();
  double max = std::numeric_limits<double>::infinity();
};
constexpr Range kPositive{std::numeric_limits<double>::min()};
constexpr Range kNotNegative{0.0};
constexpr Range kShare{0.0, 1.0};

struct OptionInfo {
  std::string key;
  std::string unit;     ///< `m`, `rad`, ..., or empty
  std::string meaning;  ///< one sentence
  Range range;
  std::vector<std::string> choices;  ///< for strings: the allowed words, or empty
};

/** Walks over the options of a stage. Each options struct lists its members once, in its `visit()`;
 * the ini reader, the effective ini and docs/parameters.md all come from that list. */
class OptionVisitor {
 public:
  virtual ~OptionVisitor() = default;

  void operator()(const char* key, double& value, const char* unit, const char* meaning,
                  Range range = {}) {
    onOption({key, unit, meaning, range, {}}, value);
  }
  void operator()(const char* key, int& value, const char* unit, const char* meaning,
                  Range range = {}) {
    onOption({key, unit, meaning, range, {}}, value);
  }
  void operator()(const char* key, bool& value, const char* meaning) {
    onOption({key, "", meaning, {}, {}}, value);
  }
  void operator()(const char* key, std::string& value, const char* meaning,
                  std::vector<std::string> choices = {}) {
    onOption({key, "", meaning, {}, std::move(choices)}, value);
  }
  /** \param unit of each number; \param size how many numbers an entry must have, 0 for any. An
   * empty list means "not set". */
  void operator()(const char* key, std::vector<double>& value, size_t size, const char* unit,
                  const char* meaning, Range range = {}) {
    onOption({key, unit, meaning, range, {}}, value, size);
  }
  /** Comma-separated list of words. */
  void operator()(const char* key, std::vector<std::string>& value, const char* meaning) {
    onOption({key, "", meaning, {}, {}}, value);
  }

 protected:
  virtual void onOption(const OptionInfo& info, double& value) = 0;
  virtual void onOption(const OptionInfo& info, int& value) = 0;
  virtual void onOption(const OptionInfo& info, bool& value) = 0;
  virtual void onOption(const OptionInfo& info, std::string& value) = 0;
  virtual void onOption(const OptionInfo& info, std::vector<double>& value, size_t size) = 0;
  virtual void onOption(const OptionInfo& info, std::vector<std::string>& value) = 0;
};

}  // namespace lamp
