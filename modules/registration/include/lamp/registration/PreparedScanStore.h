#pragma once

#include <map>
#include <tuple>
#include <unordered_map>
#include <vector>

#include "lamp/core/KeyframePacket.h"
#include "lamp/core/LoopClosure.h"
#include "lamp/core/Options.h"
#include "lamp/scans/PreparedScan.h"

namespace lamp {

struct PreparationOptions {
  int accumulate_neighbors = 2;
  ScanPreparationOptions scan;

  void visit(OptionVisitor& v);
};

/** Keyed scans of all key nodes, and what registration computes from them once.
 *
 * A source is the key node's scan alone; a target is accumulated from the neighbours before and
 * after it, placed by odometry (paper II-C), so that optimisation does not invalidate it.
 */
class PreparedScanStore {
 public:
  /** A key node's scan with up to so many neighbours on each side. */
  struct Key {
    KeyframeId id;
    uint32_t before = 0, after = 0;

    friend bool operator<(const Key& a, const Key& b) {
      return std::tie(a.id, a.before, a.after) < std::tie(b.id, b.before, b.after);
    }
    friend bool operator==(const Key& a, const Key& b) {
      return a.id == b.id && a.before == b.before && a.after == b.after;
    }
  };

  explicit PreparedScanStore(const PreparationOptions& options) : options_(options) {}

  /** The key nodes of a pair with their neighbours. Of one robot's they never reach each other: no
   * scan is matched with itself. */
  Key source(const LoopClosureCandidate& candidate) const { return key(candidate.to, candidate); }
  Key target(const LoopClosureCandidate& candidate) const { return key(candidate.from, candidate); }

  void add(const KeyframePacket& packet);
  /** The sorted, distinct keys among `wanted` that are not prepared yet, or were prepared before
   * all their neighbours had arrived. */
  std::vector<Key> missing(std::vector<Key> wanted) const;
  /** Does the work for one key; safe to call from many threads while nothing else changes. */
  PreparedScanPtr prepare(const Key& key) const;
  void insert(const Key& key, PreparedScanPtr prepared);
  /** \throws std::out_of_range if it was not inserted. */
  PreparedScanPtr get(const Key& key) const { return entries_.at(key).prepared; }

 private:
  Key key(KeyframeId id, const LoopClosureCandidate& candidate) const;
  struct Keyframe {
    Pose3 odom_T_base = Pose3::Identity();
    KeyedScanPtr scan;
    bool planar = false;
  };
  struct Entry {
    PreparedScanPtr prepared;
    size_t scans = 0;  ///< how many scans it was made of
  };
  /** The key nodes whose scans make up the prepared one. */
  std::vector<KeyframeId> members(const Key& key) const;

  PreparationOptions options_;
  std::unordered_map<KeyframeId, Keyframe> keyframes_;
  std::map<Key, Entry> entries_;
};

}  // namespace lamp
