#include "NumberRows.h"

#include <cmath>
#include <sstream>
#include <stdexcept>

#include "lamp/core/Csv.h"
#include "lamp/core/Files.h"

namespace lamp::evaluation {

void readNumberRows(const std::string& path, size_t columns, const std::string& meaning,
                    const std::function<void(const std::vector<double>&)>& take) {
  std::istringstream in(readTextFile(path));
  std::string line;
  bool empty = true;
  for (int number = 1; std::getline(in, line); ++number) {
    std::istringstream words(line.substr(0, line.find('#')));
    std::vector<double> values;
    bool good = true;
    for (std::string word; words >> word;) {
      values.push_back(0);
      good = good && parseDouble(word, values.back()) && std::isfinite(values.back());
    }
    if (values.empty()) continue;
    if (!good || values.size() != columns)
      throw std::runtime_error(path + ":" + std::to_string(number) + ": is no '" + meaning + "'");
    take(values);
    empty = false;
  }
  if (empty) throw std::runtime_error(path + ": holds no '" + meaning + "'");
}

}  // namespace lamp::evaluation
