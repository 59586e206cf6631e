#pragma once

#include <algorithm>
#include <iterator>

namespace lamp {

/** The upper median. \param values any container of numbers, not empty. */
template <class Values>
typename Values::value_type medianOf(Values values) {
  const auto middle = std::next(std::begin(values), values.size() / 2);
  std::nth_element(std::begin(values), middle, std::end(values));
  return *middle;
}

}  // namespace lamp
