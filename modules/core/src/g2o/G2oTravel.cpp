#include "g2o/G2oTravel.h"

#include <algorithm>
#include <map>
#include <stdexcept>
#include <utility>

#include "g2o/TravelOrder.h"
#include "lamp/core/DisjointSets.h"

namespace lamp {

namespace {

class Traveller {
 public:
  Traveller(const G2oLines& file, const G2oNodes& nodes, const std::vector<const G2oLine*>& edges)
      : file_(file), nodes_(nodes) {
    numberNodes();
    for (const G2oLine* line : edges) {
      if (!line->is(G2oKind::kRelativePose) || letterOf(line->ids[0]) != letterOf(line->ids[1]))
        continue;
      lines_.push_back(line);
      sequences_.pairs.push_back({number_.at(line->ids[0]), number_.at(line->ids[1])});
    }
    orderVertices();
  }

  G2oTravel travel(const OdometryEdges& choice) {
    const TravelOrder order = choice.rule == OdometryRule::kListed
                                  ? travelOrder(sequences_, listedPairs(choice))
                                  : travelOrder(sequences_, choice.rule);
    G2oTravel result{letters_, {}, {}, order.rule};
    for (const char letter : letters_)
      for (const size_t i : order.nodes)
        if (letterOf(sequences_.ids[i]) == letter) result.ids.push_back(sequences_.ids[i]);
    for (const size_t e : order.odometry) result.odometry.insert(lines_[e]);
    return result;
  }

 private:
  void numberNodes() {
    for (const auto& [id, node] : nodes_.poses())
      if (std::find(letters_.begin(), letters_.end(), letterOf(id)) == letters_.end())
        letters_.push_back(letterOf(id));
    for (const char letter : letters_)
      for (const auto& [id, node] : nodes_.poses())
        if (letterOf(id) == letter) {
          number_[id] = sequences_.ids.size();
          sequences_.ids.push_back(id);
        }
  }

  void orderVertices() {
    std::vector<size_t>& vertices = sequences_.vertices;
    std::vector<bool> done(sequences_.ids.size(), false);
    const auto add = [&](size_t node) {
      if (!done[node]) vertices.push_back(node);
      done[node] = true;
    };
    for (const char letter : letters_)
      for (const G2oLine& line : file_.lines)
        if (line.is(G2oKind::kPose) && letterOf(line.ids[0]) == letter)
          add(number_.at(line.ids[0]));
    for (size_t node = 0; node < done.size(); ++node) add(node);
  }

  /** The first edge of each pair. */
  std::vector<size_t> listedPairs(const OdometryEdges& choice) const {
    std::map<std::pair<uint64_t, uint64_t>, size_t> first;
    for (size_t e = 0; e < lines_.size(); ++e)
      first.try_emplace(std::minmax(lines_[e]->ids[0], lines_[e]->ids[1]), e);
    std::set<size_t> listed;
    DisjointSets chains(sequences_.ids.size());
    std::vector<int> degree(sequences_.ids.size(), 0);
    for (const auto& [a, b] : choice.pairs) {
      const auto refuse = [&, &a = a, &b = b](const std::string& why) {
        throw std::runtime_error(file_.name + ": odometry " + std::to_string(a) + " " +
                                 std::to_string(b) + ": " + why);
      };
      const auto found = first.find(std::minmax(a, b));
      if (found == first.end())
        refuse("the file has no edge between two nodes of one robot with these ids");
      if (!listed.insert(found->second).second) continue;
      const auto [from, to] = sequences_.pairs[found->second];
      if (++degree[from] > 2 || ++degree[to] > 2 || chains.joined(from, to))
        refuse(
            "together with the pairs before it, this is not a chain; a robot comes to a node from "
            "one other, "
            "and goes on to one other");
      chains.join(from, to);
    }
    return {listed.begin(), listed.end()};
  }

  const G2oLines& file_;
  const G2oNodes& nodes_;
  std::vector<char> letters_;
  std::map<uint64_t, size_t> number_;  ///< of each id in sequences_
  NodeSequences sequences_;
  std::vector<const G2oLine*> lines_;  ///< of sequences_.pairs
};

}  // namespace

G2oTravel travelOf(const G2oLines& file, const G2oNodes& nodes,
                   const std::vector<const G2oLine*>& edges, const OdometryEdges& choice) {
  return Traveller(file, nodes, edges).travel(choice);
}

}  // namespace lamp
