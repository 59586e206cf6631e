#include "OccupancyCounts.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <limits>
#include <stdexcept>

namespace lamp {

namespace {

/** What one scan says of one block. */
struct Share {
  BlockKey block = 0;
  const ScanEvidence* scan = nullptr;
  const BlockRays* rays = nullptr;
};

/** What several scans say, block by block. */
class Shares {
 public:
  explicit Shares(const std::vector<ScanEvidence>& scans) {
    for (const ScanEvidence& scan : scans)
      for (const auto& [block, rays] : scan.rays.blocks)
        if (rays.saysSomething()) shares_.push_back({block, &scan, &rays});
    std::sort(shares_.begin(), shares_.end(),
              [](const Share& a, const Share& b) { return a.block < b.block; });
    for (size_t i = 0; i < shares_.size(); ++i)
      if (i == 0 || shares_[i].block != shares_[i - 1].block) begins_.push_back(i);
    begins_.push_back(shares_.size());
  }

  size_t blocks() const { return begins_.size() - 1; }
  BlockKey key(size_t block) const { return shares_[begins_[block]].block; }
  template <class Visit>
  void visit(size_t block, Visit&& visit) const {
    for (size_t i = begins_[block]; i < begins_[block + 1]; ++i) visit(shares_[i]);
  }

 private:
  std::vector<Share> shares_;
  std::vector<size_t> begins_;
};

/** Calls `visit(place)` for each bit. */
template <class Visit>
void forEachBit(size_t word, uint64_t bits, Visit&& visit) {
  for (; bits != 0; bits &= bits - 1) visit(word * 64 + static_cast<size_t>(__builtin_ctzll(bits)));
}

/** \param sign 1 adds, -1 subtracts. */
void count(uint16_t& scans, int sign) {
  if (sign > 0 && scans == std::numeric_limits<uint16_t>::max())
    throw std::runtime_error(
        "more than 65535 key nodes see one place: map with fewer, by a larger min_distance_m");
  scans = static_cast<uint16_t>(scans + sign);
}

void change(CountsBlock& counts, const Share& share, int sign) {
  const uint32_t time = static_cast<uint32_t>(sign) * share.scan->time;
  for (size_t word = 0; word < kBlockSide; ++word) {
    forEachBit(word, share.rays->pass(word),
               [&](size_t place) { count(counts.passes(place), sign); });
    forEachBit(word, share.rays->hit.words[word], [&](size_t place) {
      VoxelCounts& voxel = counts.makeAt(place);
      count(voxel.hits, sign);
      voxel.hit_times += time;
    });
    if (!share.scan->new_place) continue;
    forEachBit(word, share.rays->clearPass(word), [&](size_t place) {
      VoxelCounts& voxel = counts.makeAt(place);
      count(voxel.clear_passes, sign);
      voxel.clear_times += time;
    });
  }
}

}  // namespace

VoxelCounts& CountsBlock::makeAt(size_t place) {
  std::unique_ptr<Layer>& layer = layers_[place / 64];
  if (!layer) layer = std::make_unique<Layer>();
  return (*layer)[place % 64];
}

bool CountsBlock::isEmpty() const {
  const auto isUnhit = [](const std::unique_ptr<Layer>& layer) {
    return !layer || std::all_of(layer->begin(), layer->end(),
                                 [](const VoxelCounts& voxel) { return voxel.hits == 0; });
  };
  return std::all_of(passes_.begin(), passes_.end(), [](uint16_t n) { return n == 0; }) &&
         std::all_of(layers_.begin(), layers_.end(), isUnhit);
}

void OccupancyCounts::add(const std::vector<ScanEvidence>& scans) {
  const Shares shares(scans);
  std::vector<CountsBlock*> targets;
  for (size_t i = 0; i < shares.blocks(); ++i) {
    std::unique_ptr<CountsBlock>& block = blocks_[shares.key(i)];
    if (!block) block = std::make_unique<CountsBlock>();
    targets.push_back(block.get());
  }
  tbb::parallel_for(size_t{0}, targets.size(), [&](size_t i) {
    shares.visit(i, [&](const Share& share) { change(*targets[i], share, 1); });
  });
}

void OccupancyCounts::subtract(const std::vector<ScanEvidence>& scans) {
  const Shares shares(scans);
  std::vector<uint8_t> empty(shares.blocks());
  tbb::parallel_for(size_t{0}, shares.blocks(), [&](size_t i) {
    CountsBlock& block = *blocks_.at(shares.key(i));
    shares.visit(i, [&](const Share& share) { change(block, share, -1); });
    empty[i] = block.isEmpty() ? 1 : 0;
  });
  for (size_t i = 0; i < shares.blocks(); ++i)
    if (empty[i]) blocks_.erase(shares.key(i));
}

}  // namespace lamp
