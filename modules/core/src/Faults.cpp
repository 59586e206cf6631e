#include "lamp/core/Faults.h"

#include <algorithm>
#include <numeric>

namespace lamp {

namespace {

size_t editDistance(const std::string& a, const std::string& b) {
  std::vector<size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), size_t{0});
  for (size_t i = 1; i <= a.size(); ++i) {
    size_t diagonal = row[0];
    row[0] = i;
    for (size_t j = 1; j <= b.size(); ++j) {
      const size_t substituted = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
      diagonal = row[j];
      row[j] = std::min({row[j] + 1, row[j - 1] + 1, substituted});
    }
  }
  return row.back();
}

}  // namespace

void Faults::add(const std::string& where, const std::string& message) {
  faults_.push_back(where.empty() ? message : where + ": " + message);
}

void Faults::throwIfAny() const {
  if (faults_.empty()) return;
  std::string text;
  for (const std::string& fault : faults_) text += (text.empty() ? "" : "\n") + fault;
  throw ConfigError(text);
}

std::string didYouMean(const std::string& word, const std::vector<std::string>& known) {
  const auto nearest =
      std::min_element(known.begin(), known.end(), [&](const std::string& a, const std::string& b) {
        return editDistance(word, a) < editDistance(word, b);
      });
  if (nearest == known.end() || editDistance(word, *nearest) > std::max<size_t>(2, word.size() / 3))
    return "";
  return " (did you mean '" + *nearest + "'?)";
}

}  // namespace lamp
