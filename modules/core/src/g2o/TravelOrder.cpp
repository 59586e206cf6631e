#include "g2o/TravelOrder.h"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <set>

#include "lamp/core/DisjointSets.h"

namespace lamp {

namespace {

/** Ids in no order at all chain hardly any nodes, odometry with many gaps still some. */
constexpr size_t kFarBetter = 4;

std::vector<size_t> upTo(size_t size) {
  std::vector<size_t> numbers(size);
  std::iota(numbers.begin(), numbers.end(), size_t{0});
  return numbers;
}

/** Pairs of neighbours in a sequence. */
TravelOrder alongSequence(const NodeSequences& file, OdometryRule rule,
                          std::vector<size_t> sequence) {
  const size_t count = file.ids.size();
  std::vector<bool> reached(count, false), followed(count, false);
  for (const NodePair& pair : file.pairs) reached[pair.from] = reached[pair.to] = true;
  std::stable_partition(sequence.begin(), sequence.end(), [&](size_t i) { return reached[i]; });
  std::vector<size_t> place(count);
  for (size_t i = 0; i < count; ++i) place[sequence[i]] = i;

  TravelOrder order{rule, std::move(sequence), {}};
  for (size_t e = 0; e < file.pairs.size(); ++e) {
    const auto [from, to] = file.pairs[e];
    const auto [first, second] = std::minmax(place[from], place[to]);
    const auto [low, high] = std::minmax(file.ids[from], file.ids[to]);
    if (second - first != 1 || followed[first]) continue;
    if (rule == OdometryRule::kNext && high - low != 1) continue;
    followed[first] = true;
    order.odometry.push_back(e);
  }
  return order;
}

/** The pieces that odometry joins, one after the other as they begin in the file, each in the
 * direction of most of its pairs. */
class Pieces {
 public:
  Pieces(const NodeSequences& file, const std::vector<size_t>& odometry)
      : file_(file), at_(file.ids.size()), visited_(file.ids.size(), false) {
    for (const size_t e : odometry) {
      at_[file.pairs[e].from].push_back(e);
      at_[file.pairs[e].to].push_back(e);
    }
    for (const size_t e : odometry) addPiece(file.pairs[e].from);
    for (const NodePair& pair : file.pairs) {
      addNode(pair.from);
      addNode(pair.to);
    }
    for (size_t i = 0; i < at_.size(); ++i) addNode(i);
  }

  std::vector<size_t> take() { return std::move(nodes_); }

 private:
  /** From a node to the end that lies behind one of its pairs. */
  std::vector<size_t> walk(size_t node, size_t by) const {
    std::vector<size_t> path = {node};
    for (;;) {
      const NodePair& pair = file_.pairs[by];
      node = pair.from == node ? pair.to : pair.from;
      path.push_back(node);
      const auto next =
          std::find_if(at_[node].begin(), at_[node].end(), [&](size_t e) { return e != by; });
      if (next == at_[node].end()) return path;
      by = *next;
    }
  }

  /** One that no odometry reaches. */
  void addNode(size_t node) {
    if (visited_[node]) return;
    visited_[node] = true;
    nodes_.push_back(node);
  }

  void addPiece(size_t node) {
    if (visited_[node]) return;
    const size_t end = walk(node, at_[node].front()).back();
    std::vector<size_t> piece = walk(end, at_[end].front());
    std::ptrdiff_t forwards = 0;
    for (size_t k = 0; k + 1 < piece.size(); ++k) {
      visited_[piece[k]] = visited_[piece[k + 1]] = true;
      for (const size_t e : at_[piece[k]]) {
        if (file_.pairs[e].to == piece[k + 1]) ++forwards;
        if (file_.pairs[e].from == piece[k + 1]) --forwards;
      }
    }
    if (forwards < 0) std::reverse(piece.begin(), piece.end());
    nodes_.insert(nodes_.end(), piece.begin(), piece.end());
  }

  const NodeSequences& file_;
  std::vector<std::vector<size_t>> at_;  ///< by node, its one or two pairs
  std::vector<bool> visited_;
  std::vector<size_t> nodes_;
};

/** As many pairs as fit, one after the other, so that they make paths. */
std::vector<size_t> paths(const NodeSequences& file, const std::vector<size_t>& candidates) {
  DisjointSets pieces(file.ids.size());
  std::vector<int> degree(file.ids.size(), 0);
  std::vector<size_t> odometry;
  for (const size_t e : candidates) {
    const auto [from, to] = file.pairs[e];
    if (degree[from] == 2 || degree[to] == 2 || pieces.joined(from, to)) continue;
    pieces.join(from, to);
    ++degree[from];
    ++degree[to];
    odometry.push_back(e);
  }
  std::sort(odometry.begin(), odometry.end());
  return odometry;
}

/** Along the edges as they come; or, if that leaves fewer gaps, first those of nodes that have no
 * others than one from where the robot came and one to where it went. */
TravelOrder alongEdges(const NodeSequences& file) {
  std::vector<std::set<size_t>> neighbours(file.ids.size());
  for (const auto [from, to] : file.pairs) {
    neighbours[from].insert(to);
    neighbours[to].insert(from);
  }
  std::vector<size_t> candidates = upTo(file.pairs.size());
  std::vector<size_t> odometry = paths(file, candidates);
  std::stable_partition(candidates.begin(), candidates.end(), [&](size_t e) {
    const auto [from, to] = file.pairs[e];
    return std::min(neighbours[from].size(), neighbours[to].size()) <= 2;
  });
  std::vector<size_t> without_loops_first = paths(file, candidates);
  if (without_loops_first.size() > odometry.size()) odometry = std::move(without_loops_first);
  return {OdometryRule::kEdges, Pieces(file, odometry).take(), odometry};
}

}  // namespace

TravelOrder travelOrder(const NodeSequences& file, OdometryRule rule) {
  if (rule == OdometryRule::kVertices) return alongSequence(file, rule, file.vertices);
  if (rule == OdometryRule::kEdges) return alongEdges(file);
  if (rule != OdometryRule::kAuto) return alongSequence(file, rule, upTo(file.ids.size()));
  TravelOrder by_ids = travelOrder(file, OdometryRule::kIds);
  TravelOrder by_vertices = travelOrder(file, OdometryRule::kVertices);
  TravelOrder by_edges = travelOrder(file, OdometryRule::kEdges);
  const auto good = [&](const TravelOrder& order) {
    return kFarBetter * order.odometry.size() >=
           std::max(by_vertices.odometry.size(), by_edges.odometry.size());
  };
  if (good(by_ids)) return by_ids;
  return good(by_vertices) ? by_vertices : by_edges;
}

TravelOrder travelOrder(const NodeSequences& file, const std::vector<size_t>& listed) {
  return {OdometryRule::kListed, Pieces(file, listed).take(), listed};
}

}  // namespace lamp
