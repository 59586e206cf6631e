#include "OccupancyMap.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace lamp {

namespace {

/** Looks from places nearer than this to each other see the same side of things, metres. */
constexpr double kNewPlace = 0.5;

/** How far a point at the range moves at most between the poses, metres. */
double movement(const Pose3& a, const Pose3& b, double range_m) {
  const Pose3 motion = a.inverse() * b;
  return motion.translation().norm() +
         (motion.linear() - Eigen::Matrix3d::Identity()).norm() * range_m;
}

}  // namespace

uint16_t OccupancyMap::Clock::at(double stamp) const {
  constexpr double kMost = std::numeric_limits<uint16_t>::max();
  return static_cast<uint16_t>(std::clamp(std::floor((stamp - epoch) / second), 0.0, kMost));
}

OccupancyMap::Clock OccupancyMap::clockFor(const ComponentMap& map) {
  Clock clock;
  double last = -std::numeric_limits<double>::infinity();
  clock.epoch = -last;
  for (const MapKeyNode& key_node : map.key_nodes) {
    clock.epoch = std::min(clock.epoch, key_node.stamp);
    last = std::max(last, key_node.stamp);
  }
  while ((last - clock.epoch) / clock.second > std::numeric_limits<uint16_t>::max())
    clock.second *= 2;
  return clock;
}

OccupancyMap::Entries OccupancyMap::entriesOf(const ComponentMap& map, const Clock& clock) const {
  Entries entries;
  const MapKeyNode* before = nullptr;
  for (const MapKeyNode& key_node : map.key_nodes) {
    const bool new_place =
        !before || before->id.robot != key_node.id.robot ||
        (before->world_T_base.translation() - key_node.world_T_base.translation()).norm() >=
            kNewPlace;
    before = &key_node;
    if (key_node.scan)
      entries[key_node.id] = {key_node.world_T_base, key_node.scan, clock.at(key_node.stamp),
                              new_place};
  }
  return entries;
}

bool OccupancyMap::isSame(const Entry& a, const Entry& b) const {
  const bool stayed =
      a.world_T_base.matrix() == b.world_T_base.matrix() ||
      movement(a.world_T_base, b.world_T_base, options_.max_range_m) < options_.tolerance_m;
  return a.scan == b.scan && a.time == b.time && a.new_place == b.new_place && stayed;
}

bool OccupancyMap::forgetAll() {
  const bool knew_something = !entries_.empty();
  entries_.clear();
  counts_.clear();
  return knew_something;
}

bool OccupancyMap::update(const ComponentMap& map) {
  const Clock clock = clockFor(map);
  bool changed = false;
  if (!clock_ || !(*clock_ == clock)) {
    changed = forgetAll();
    clock_ = clock;
  }
  return exchange(entriesOf(map, clock)) || changed;
}

bool OccupancyMap::exchange(const Entries& wanted) {
  std::vector<Entries::iterator> old;
  for (auto entry = entries_.begin(); entry != entries_.end(); ++entry) {
    const auto same = wanted.find(entry->first);
    if (same == wanted.end() || !isSame(entry->second, same->second)) old.push_back(entry);
  }
  // Where more goes than stays it is less work to begin anew.
  bool changed = false;
  if (2 * old.size() > entries_.size()) {
    changed = forgetAll();
    old.clear();
  }
  std::vector<const Entry*> out, in;
  for (const auto& entry : old) out.push_back(&entry->second);
  castInBatches(out, [&](const std::vector<ScanEvidence>& scans) { counts_.subtract(scans); });
  for (const auto& entry : old) entries_.erase(entry);
  removed_ = out.size();

  for (const auto& [id, entry] : wanted)
    if (const auto [place, is_new] = entries_.emplace(id, entry); is_new)
      in.push_back(&place->second);
  rays_out_of_bounds_ = 0;
  castInBatches(in, [&](const std::vector<ScanEvidence>& scans) { counts_.add(scans); });
  inserted_ = in.size();
  return changed || removed_ + inserted_ > 0;
}

template <class Take>
void OccupancyMap::castInBatches(const std::vector<const Entry*>& entries, Take&& take) {
  constexpr size_t kBatch = 32;  // some 20 MB of rays
  for (size_t begin = 0; begin < entries.size(); begin += kBatch) {
    std::vector<ScanEvidence> scans(std::min(kBatch, entries.size() - begin));
    tbb::parallel_for(size_t{0}, scans.size(), [&](size_t i) {
      const Entry& entry = *entries[begin + i];
      scans[i] = {
          castRays(*entry.scan, entry.world_T_base, options_.resolution_m, options_.max_range_m),
          entry.time, entry.new_place};
    });
    for (const ScanEvidence& scan : scans) rays_out_of_bounds_ += scan.rays.out_of_bounds;
    take(scans);
  }
}

}  // namespace lamp
