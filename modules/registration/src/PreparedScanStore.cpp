#include "lamp/registration/PreparedScanStore.h"

#include <algorithm>

namespace lamp {

void PreparationOptions::visit(OptionVisitor& v) {
  v("accumulate_neighbors", accumulate_neighbors, "key nodes",
    "neighbouring key nodes on each side whose scans are merged into a key node's; none for robots "
    "in the plane",
    kNotNegative);
  v("accumulate_voxel_m", accumulate_voxel_m, "m",
    "a neighbour's point is added only if no other point lies in its voxel of this size",
    kPositive);
  v("memory_limit_mb", memory_limit_mb, "MB",
    "memory for prepared scans; the least recently used ones are dropped and prepared again when "
    "needed",
    {1});
  scan.visit(v);
}

void PreparedScanStore::add(const KeyNodePacket& packet) {
  key_nodes_[packet.id] = {packet.odom_T_base, packet.scan, packet.planar};
}

PreparedScanStore::Key PreparedScanStore::key(KeyNodeId id,
                                              const LoopClosureCandidate& candidate) const {
  // Wheel odometry would only blur the few lines that a laser in the plane sees.
  const auto key_node = key_nodes_.find(id);
  const bool planar = key_node != key_nodes_.end() && key_node->second.planar;
  auto reach = planar ? 0 : static_cast<uint32_t>(options_.accumulate_neighbors);
  if (candidate.from.robot == candidate.to.robot) {
    const auto [first, last] = std::minmax(candidate.from.index, candidate.to.index);
    reach = std::min(reach, last > first ? (last - first - 1) / 2 : 0);
  }
  return {id, reach, reach};
}

std::vector<KeyNodeId> PreparedScanStore::members(const Key& key) const {
  std::vector<KeyNodeId> ids;
  const uint32_t first = key.id.index > key.before ? key.id.index - key.before : 0;
  for (uint32_t index = first; index <= key.id.index + key.after; ++index)
    if (key_nodes_.count({key.id.robot, index})) ids.push_back({key.id.robot, index});
  return ids;
}

PreparedScanPtr PreparedScanStore::prepare(const Key& key) const {
  const KeyNode& center = key_nodes_.at(key.id);
  std::vector<PlacedScan> scans{{center.scan, Pose3::Identity()}};
  for (const KeyNodeId id : members(key)) {
    if (id == key.id) continue;
    const KeyNode& key_node = key_nodes_.at(id);
    scans.push_back({key_node.scan, center.odom_T_base.inverse() * key_node.odom_T_base});
  }
  return std::make_shared<PreparedScan>(accumulate(scans, options_.accumulate_voxel_m),
                                        options_.scan, center.planar);
}

PreparedScanPtr PreparedScanStore::get(const Key& key) {
  const EntryPtr entry = find(key);
  std::call_once(entry->once, [&] {
    entry->prepared = prepare(key);
    account(key, entry);
  });
  return entry->prepared;
}

/** The entry of the key, marked as used last; a new one if there is none that is up to date. */
PreparedScanStore::EntryPtr PreparedScanStore::find(const Key& key) {
  const size_t scans = members(key).size();
  const std::lock_guard lock(mutex_);
  auto found = entries_.find(key);
  if (found != entries_.end() && found->second->scans != scans) {
    forget(found);
    found = entries_.end();
  }
  if (found == entries_.end()) {
    found = entries_.emplace(key, std::make_shared<Entry>()).first;
    found->second->scans = scans;
    uses_.push_front(key);
  } else {
    uses_.splice(uses_.begin(), uses_, found->second->use);
  }
  found->second->use = uses_.begin();
  return found->second;
}

/** Counts a new scan's memory, and makes room for it. */
void PreparedScanStore::account(const Key& key, const EntryPtr& entry) {
  const std::lock_guard lock(mutex_);
  const auto place = entries_.find(key);
  if (place == entries_.end() || place->second != entry) return;
  entry->counted = true;
  bytes_ += entry->prepared->bytes();
  const size_t limit = static_cast<size_t>(options_.memory_limit_mb) << 20;
  while (bytes_ > limit && uses_.size() > 1) {
    const auto oldest = entries_.find(uses_.back());
    if (oldest->second == entry) break;
    forget(oldest);
  }
}

void PreparedScanStore::forget(std::map<Key, EntryPtr>::iterator place) {
  const EntryPtr entry = place->second;
  uses_.erase(entry->use);
  entries_.erase(place);
  if (!entry->counted) return;
  bytes_ -= entry->prepared->bytes();
  ++forgotten_.scans;
  forgotten_.seconds += entry->prepared->secondsOfPreparation();
}

PreparationReport PreparedScanStore::report() const {
  const std::lock_guard lock(mutex_);
  PreparationReport report = forgotten_;
  for (const auto& [key, entry] : entries_) {
    if (!entry->counted) continue;
    ++report.scans;
    report.seconds += entry->prepared->secondsOfPreparation();
  }
  return report;
}

}  // namespace lamp
