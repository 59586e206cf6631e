#include "lamp/simulation/LoopPairs.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <memory>
#include <set>

#include "lamp/core/ScanOverlap.h"

namespace lamp::simulation {

namespace {

constexpr double kSearchRangeM = 25.0, kNearM = 6.0, kLookAlikeM = 6.0;
constexpr uint32_t kMinIndexGap = 10;
constexpr double kTrueOverlap = 0.3, kFalseOverlap = 0.05;
constexpr size_t kMaxMeasured = 5;  ///< pairs measured for each one wanted

struct KeyNode {
  KeyNodeId id;
  double stamp;
  Pose3 world_T_base;
};

std::vector<KeyNode> keyNodesOf(const Mission& mission) {
  std::vector<KeyNode> nodes;
  for (size_t robot = 0; robot < mission.robots.size(); ++robot)
    for (size_t i = 0; i < mission.robots[robot].key_nodes.size(); ++i) {
      const double stamp = mission.robots[robot].stampOf(i);
      nodes.push_back({{{static_cast<uint16_t>(robot)}, static_cast<uint32_t>(i)},
                       stamp,
                       mission.robots[robot].truth.at(stamp)});
    }
  return nodes;
}

double distance(const KeyNode& a, const KeyNode& b) {
  return (a.world_T_base.translation() - b.world_T_base.translation()).norm();
}

using Pair = std::pair<size_t, size_t>;  ///< places in the list of key nodes, the first smaller

std::vector<Pair> pairsWithin(double range_m, const std::vector<KeyNode>& nodes) {
  std::vector<Pair> pairs;
  for (size_t a = 0; a < nodes.size(); ++a)
    for (size_t b = a + 1; b < nodes.size(); ++b) {
      const bool neighbours = nodes[a].id.robot == nodes[b].id.robot &&
                              nodes[b].id.index - nodes[a].id.index < kMinIndexGap;
      if (!neighbours && distance(nodes[a], nodes[b]) < range_m) pairs.emplace_back(a, b);
    }
  return pairs;
}

/** Pairs of key nodes near two different spots of one group. */
std::vector<Pair> lookAlikePairs(const std::vector<KeyNode>& nodes, const Layout& layout,
                                 size_t count, Random& random) {
  std::vector<Pair> pairs;
  for (const auto& spots : layout.look_alikes) {
    std::vector<std::vector<size_t>> near(spots.size());
    for (size_t i = 0; i < nodes.size(); ++i)
      for (size_t spot = 0; spot < spots.size(); ++spot)
        if ((nodes[i].world_T_base.translation() - spots[spot]).norm() < kLookAlikeM)
          near[spot].push_back(i);
    near.erase(std::remove_if(near.begin(), near.end(), [](const auto& n) { return n.empty(); }),
               near.end());
    if (near.size() < 2) continue;
    for (size_t i = 0; i < count; ++i) {
      const size_t first = pick(random, near.size());
      const size_t second = (first + 1 + pick(random, near.size() - 1)) % near.size();
      const size_t a = near[first][pick(random, near[first].size())],
                   b = near[second][pick(random, near[second].size())];
      if (distance(nodes[a], nodes[b]) > kSearchRangeM)
        pairs.emplace_back(std::min(a, b), std::max(a, b));
    }
  }
  return pairs;
}

void shuffle(std::vector<Pair>& pairs, Random& random) {
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  std::shuffle(pairs.begin(), pairs.end(), random);
}

/** Measures pairs until there are enough true and false ones. */
class PairCollector {
 public:
  PairCollector(const std::vector<KeyNode>& nodes,
                const std::vector<std::vector<KeyedScanPtr>>& scans)
      : nodes_(nodes), prepared_(nodes.size()) {
    tbb::parallel_for(size_t{0}, nodes.size(), [&](size_t i) {
      const KeyNodeId id = nodes[i].id;
      prepared_[i] = std::make_unique<OverlapScan>(scans[id.robot.value][id.index]->points, false);
    });
  }

  /** \param max_true, max_false of all that are collected. */
  void collect(std::vector<Pair> pairs, bool look_alike, size_t max_true, size_t max_false) {
    constexpr size_t kBatch = 256;
    const auto known = [&](const Pair& pair) { return measured_.count(pair) > 0; };
    pairs.erase(std::remove_if(pairs.begin(), pairs.end(), known), pairs.end());
    // One kind may be so rare that there are not enough of it.
    pairs.resize(std::min(pairs.size(), kMaxMeasured * (max_true + max_false)));
    for (size_t begin = 0; begin < pairs.size(); begin += kBatch) {
      if (true_count_ >= max_true && false_count_ >= max_false) return;
      std::vector<LoopPair> batch(std::min(kBatch, pairs.size() - begin));
      for (size_t i = 0; i < batch.size(); ++i) measured_.insert(pairs[begin + i]);
      tbb::parallel_for(size_t{0}, batch.size(),
                        [&](size_t i) { batch[i] = measure(pairs[begin + i], look_alike); });
      for (const LoopPair& pair : batch) {
        if (!pair.same_place && pair.overlap >= kFalseOverlap) continue;
        size_t& count = pair.same_place ? true_count_ : false_count_;
        if (count >= (pair.same_place ? max_true : max_false)) continue;
        ++count;
        found_.push_back(pair);
      }
    }
  }

  std::vector<LoopPair> take() {
    std::sort(found_.begin(), found_.end(), [](const LoopPair& a, const LoopPair& b) {
      return std::tie(a.from, a.to) < std::tie(b.from, b.to);
    });
    return std::move(found_);
  }

 private:
  LoopPair measure(const Pair& pair, bool look_alike) const {
    const KeyNode &from = nodes_[pair.first], &to = nodes_[pair.second];
    const Pose3 from_T_to = from.world_T_base.inverse() * to.world_T_base;
    const double overlap = scanOverlap(*prepared_[pair.first], *prepared_[pair.second], from_T_to);
    return {from.id,   to.id, from.stamp, to.stamp, from_T_to, overlap, overlap >= kTrueOverlap,
            look_alike};
  }

  const std::vector<KeyNode>& nodes_;
  std::vector<std::unique_ptr<OverlapScan>> prepared_;
  std::set<Pair> measured_;
  std::vector<LoopPair> found_;
  size_t true_count_ = 0, false_count_ = 0;
};

}  // namespace

std::vector<LoopPair> findLoopPairs(const Mission& mission, const Layout& layout,
                                    const std::vector<std::vector<KeyedScanPtr>>& scans,
                                    size_t pairs, uint64_t seed) {
  const std::vector<KeyNode> nodes = keyNodesOf(mission);
  Random random(mixSeeds({seed, 1}));
  std::vector<Pair> alike = lookAlikePairs(nodes, layout, pairs, random);
  std::vector<Pair> near = pairsWithin(kSearchRangeM, nodes);
  std::vector<Pair> nearest = pairsWithin(kNearM, nodes);
  for (auto* list : {&alike, &near, &nearest}) shuffle(*list, random);
  PairCollector collector(nodes, scans);
  collector.collect(std::move(near), false, pairs, alike.empty() ? pairs : pairs - pairs / 3);
  collector.collect(std::move(alike), true, pairs, pairs);
  // Behind the walls of small rooms few pairs in range see the same.
  collector.collect(std::move(nearest), false, pairs, pairs);
  return collector.take();
}

}  // namespace lamp::simulation
