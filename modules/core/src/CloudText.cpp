#include "CloudText.h"

#include <cmath>
#include <sstream>
#include <stdexcept>

#include "lamp/core/Csv.h"

namespace lamp {

bool CloudText::next(std::vector<std::string>& words) {
  std::string text;
  while (std::getline(file_, text)) {
    if (line_++ == 0 && text.rfind("\xEF\xBB\xBF", 0) == 0) text.erase(0, 3);
    words.clear();
    std::istringstream stream(text);
    for (std::string word; stream >> word;) words.push_back(word);
    if (!words.empty()) return true;
  }
  return false;
}

double CloudText::number(const std::string& word) const {
  double value = 0;
  if (parseDouble(word, value)) return value;
  const bool separated = word.find_first_of(",;") != std::string::npos;
  fail("'" + word + "' is not a number" +
       (separated ? ": numbers need a decimal point, and spaces between them" : ""));
}

void CloudText::failAt(size_t line, const std::string& what) const {
  throw std::runtime_error(name_ + ":" + std::to_string(line) + ": " + what);
}

void takeOffset(const std::vector<std::string>& words, Eigen::Vector3d& offset) {
  if (words.size() != 5 || words[1] != "offset") return;
  Eigen::Vector3d stated;
  for (int axis = 0; axis < 3; ++axis)
    if (!parseDouble(words[2 + axis], stated[axis]) || !std::isfinite(stated[axis])) return;
  offset = stated;
}

}  // namespace lamp
