#include "lamp/registration/PreparedScanStore.h"

#include <algorithm>

namespace lamp {

void PreparationOptions::visit(OptionVisitor& v) {
  v("accumulate_neighbors", accumulate_neighbors, "key nodes",
    "neighbours on each side whose scans join the target's", kNotNegative);
  v("normal_neighbors", normal_neighbors, "points", "nearest points that a normal is fitted to",
    {3});
}

void PreparedScanStore::add(const KeyframePacket& packet) {
  keyframes_[packet.id] = {packet.odom_T_base, packet.scan, packet.planar};
}

PreparedScanStore::Key PreparedScanStore::target(const LoopClosureCandidate& candidate) const {
  const auto reach = static_cast<uint32_t>(options_.accumulate_neighbors);
  Key key{candidate.from, reach, reach};
  if (candidate.from.robot == candidate.to.robot && candidate.to.index > candidate.from.index)
    key.after = std::min(reach, candidate.to.index - candidate.from.index - 1);
  return key;
}

std::vector<KeyframeId> PreparedScanStore::members(const Key& key) const {
  std::vector<KeyframeId> ids;
  const uint32_t first = key.id.index > key.before ? key.id.index - key.before : 0;
  for (uint32_t index = first; index <= key.id.index + key.after; ++index)
    if (keyframes_.count({key.id.robot, index})) ids.push_back({key.id.robot, index});
  return ids;
}

std::vector<PreparedScanStore::Key> PreparedScanStore::missing(std::vector<Key> wanted) const {
  std::sort(wanted.begin(), wanted.end());
  wanted.erase(std::unique(wanted.begin(), wanted.end()), wanted.end());
  const auto done = [&](const Key& key) {
    const auto found = entries_.find(key);
    return found != entries_.end() && found->second.scans == members(key).size();
  };
  wanted.erase(std::remove_if(wanted.begin(), wanted.end(), done), wanted.end());
  return wanted;
}

PreparedScanPtr PreparedScanStore::prepare(const Key& key) const {
  const Keyframe& center = keyframes_.at(key.id);
  std::vector<PlacedScan> scans;
  for (const KeyframeId id : members(key)) {
    const Keyframe& keyframe = keyframes_.at(id);
    scans.push_back({keyframe.scan, center.odom_T_base.inverse() * keyframe.odom_T_base});
  }
  return prepareScan(accumulate(scans), options_.normal_neighbors, center.planar);
}

void PreparedScanStore::insert(const Key& key, PreparedScanPtr prepared) {
  entries_[key] = {std::move(prepared), members(key).size()};
}

}  // namespace lamp
