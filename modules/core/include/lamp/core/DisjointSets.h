#pragma once

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <vector>

namespace lamp {

/** Numbers from 0, joined to sets; the root of a set is its least member. */
class DisjointSets {
 public:
  explicit DisjointSets(size_t size) : parent_(size) {
    std::iota(parent_.begin(), parent_.end(), size_t{0});
  }

  size_t root(size_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];  // halves the path
    return i;
  }
  bool joined(size_t a, size_t b) { return root(a) == root(b); }
  void join(size_t a, size_t b) {
    a = root(a);
    b = root(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<size_t> parent_;
};

}  // namespace lamp
