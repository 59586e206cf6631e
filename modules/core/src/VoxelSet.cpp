#include "lamp/core/VoxelSet.h"

#include "lamp/core/VoxelKey.h"

namespace lamp {

namespace {

/** Keys use 63 bits, so this is none of them. */
constexpr uint64_t kFree = ~uint64_t{0};
constexpr size_t kFirstSlots = 1024;

size_t mixBits(uint64_t key) {
  key ^= key >> 32;
  key *= 0x9E3779B97F4A7C15u;
  return key ^ (key >> 29);
}

}  // namespace

VoxelSet::VoxelSet(double voxel_m) : voxel_m_(voxel_m), slots_(kFirstSlots, kFree) {}

bool VoxelSet::insert(const Eigen::Vector3d& point) {
  if (2 * (size_ + 1) > slots_.size()) grow();
  return insertKey(keyOf(point));
}

uint64_t VoxelSet::keyOf(const Eigen::Vector3d& point) const {
  return voxelKey(point, voxel_m_);
}

bool VoxelSet::insertKey(uint64_t key) {
  const size_t mask = slots_.size() - 1;
  for (size_t i = mixBits(key) & mask;; i = (i + 1) & mask) {
    if (slots_[i] == key) return false;
    if (slots_[i] != kFree) continue;
    slots_[i] = key;
    ++size_;
    return true;
  }
}

void VoxelSet::grow() {
  std::vector<uint64_t> old(2 * slots_.size(), kFree);
  old.swap(slots_);
  size_ = 0;
  for (const uint64_t key : old)
    if (key != kFree) insertKey(key);
}

}  // namespace lamp
