#include "lamp/registration/PreparedScanStore.h"

#include <algorithm>

namespace lamp {

void PreparationOptions::visit(OptionVisitor& v) {
  v("accumulate_neighbors", accumulate_neighbors, "key nodes",
    "neighbours on each side whose scans join the target's", kNotNegative);
  scan.visit(v);
}

void PreparedScanStore::add(const KeyframePacket& packet) {
  keyframes_[packet.id] = {packet.odom_T_base, packet.scan, packet.planar};
}

PreparedScanStore::Key PreparedScanStore::key(KeyframeId id,
                                              const LoopClosureCandidate& candidate) const {
  auto reach = static_cast<uint32_t>(options_.accumulate_neighbors);
  if (candidate.from.robot == candidate.to.robot) {
    const auto [first, last] = std::minmax(candidate.from.index, candidate.to.index);
    reach = std::min(reach, last > first ? (last - first - 1) / 2 : 0);
  }
  return {id, reach, reach};
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
  std::vector<PlacedScan> scans{{center.scan, Pose3::Identity()}};
  for (const KeyframeId id : members(key)) {
    if (id == key.id) continue;
    const Keyframe& keyframe = keyframes_.at(id);
    scans.push_back({keyframe.scan, center.odom_T_base.inverse() * keyframe.odom_T_base});
  }
  return std::make_shared<PreparedScan>(accumulate(scans), options_.scan, center.planar);
}

void PreparedScanStore::insert(const Key& key, PreparedScanPtr prepared) {
  entries_[key] = {std::move(prepared), members(key).size()};
}

}  // namespace lamp
