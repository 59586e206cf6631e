#pragma once

#include "lamp/simulation/Layout.h"

namespace lamp::test {

using namespace simulation;

inline void addPassage(Layout& layout, size_t from, size_t to, double width_m,
                       const std::vector<Eigen::Vector3d>& between = {}) {
  Passage passage;
  passage.from = from;
  passage.to = to;
  passage.width_m = width_m;
  passage.floor = {layout.places[from]};
  passage.floor.insert(passage.floor.end(), between.begin(), between.end());
  passage.floor.push_back(layout.places[to]);
  layout.passages.push_back(passage);
}

/** A lead of 10 m to a ring of 20 x 20 m with a dead end of 15 m. */
inline Layout ringLayout() {
  Layout layout;
  layout.places = {{0, 0, 0}, {10, 0, 0}, {30, 0, 0}, {30, 20, 0}, {10, 20, 0}, {45, 0, 0}};
  addPassage(layout, 0, 1, 3.0);
  addPassage(layout, 1, 2, 4.0, {{20, 0, 0}});
  addPassage(layout, 2, 3, 5.0);
  addPassage(layout, 3, 4, 6.0);
  addPassage(layout, 4, 1, 7.0);
  addPassage(layout, 2, 5, 3.5);
  return layout;
}

/** One passage of 10 m, from the gate to a dead end. */
inline Layout deadEndLayout() {
  Layout layout;
  layout.places = {{0, 0, 0}, {10, 0, 0}};
  addPassage(layout, 0, 1, 3.0);
  return layout;
}

}  // namespace lamp::test
