#include "rejection/GrowingClique.h"

#include <algorithm>

namespace lamp {

namespace {

/** Vertices sorted into classes, within which no two are joined. No clique among the first k
 * vertices is larger than the class number of the k-th. */
struct Colouring {
  std::vector<int> vertices;
  std::vector<size_t> colours;  ///< from 1
};

template <class Joined>
Colouring colour(const std::vector<int>& vertices, Joined joined) {
  std::vector<std::vector<int>> classes;
  for (const int vertex : vertices) {
    const auto free = [&](const std::vector<int>& members) {
      return std::none_of(members.begin(), members.end(),
                          [&](int member) { return joined(vertex, member); });
    };
    const auto found = std::find_if(classes.begin(), classes.end(), free);
    if (found == classes.end())
      classes.push_back({vertex});
    else
      found->push_back(vertex);
  }
  Colouring result;
  for (size_t c = 0; c < classes.size(); ++c)
    for (const int vertex : classes[c]) {
      result.vertices.push_back(vertex);
      result.colours.push_back(c + 1);
    }
  return result;
}

}  // namespace

void GrowingClique::add(const std::vector<bool>& neighbours) {
  const int vertex = static_cast<int>(rows_.size());
  rows_.push_back(neighbours);
  if (std::all_of(best_.begin(), best_.end(), [&](int member) { return neighbours[member]; })) {
    best_.push_back(vertex);
    return;
  }
  std::vector<int> candidates, chosen = {vertex};
  for (int other = 0; other < vertex; ++other)
    if (neighbours[other]) candidates.push_back(other);
  if (candidates.size() < best_.size()) return;
  steps_ = 0;
  expand(chosen, candidates);
  if (steps_ > max_steps_) exact_ = false;
}

void GrowingClique::expand(std::vector<int>& chosen, const std::vector<int>& candidates) {
  if (candidates.empty()) {
    if (chosen.size() <= best_.size()) return;
    best_ = chosen;
    std::sort(best_.begin(), best_.end());
    return;
  }
  const auto joined_to = [&](int a, int b) { return joined(a, b); };
  const Colouring coloured = colour(candidates, joined_to);
  for (size_t i = coloured.vertices.size(); i-- > 0;) {
    if (chosen.size() + coloured.colours[i] <= best_.size()) return;
    if (++steps_ > max_steps_) return;
    const int vertex = coloured.vertices[i];
    std::vector<int> rest;
    for (size_t k = 0; k < i; ++k)
      if (joined(vertex, coloured.vertices[k])) rest.push_back(coloured.vertices[k]);
    chosen.push_back(vertex);
    expand(chosen, rest);
    chosen.pop_back();
  }
}

}  // namespace lamp
