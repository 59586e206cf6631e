#pragma once

#include <list>
#include <map>
#include <mutex>
#include <tuple>
#include <unordered_map>
#include <vector>

#include "lamp/core/KeyNodePacket.h"
#include "lamp/core/LoopClosure.h"
#include "lamp/core/Options.h"
#include "lamp/scans/PreparedScan.h"

namespace lamp {

struct PreparationOptions {
  int accumulate_neighbors = 2;
  double accumulate_voxel_m = 0.2;
  int memory_limit_mb = 1000;
  ScanPreparationOptions scan;

  void visit(OptionVisitor& v);
};

/** What the preparation of scans has cost. */
struct PreparationReport {
  size_t scans = 0;    ///< prepared; counted again if prepared again
  double seconds = 0;  ///< of all threads together
};

/** Keyed scans of all key nodes, and what registration computes from them once.
 *
 * A scan is prepared together with its neighbours before and after it, placed by odometry (paper
 * II-C), so that optimisation does not invalidate it. What was not used for longest goes when the
 * memory is full, and is prepared again when it is needed.
 */
class PreparedScanStore {
 public:
  /** A key node's scan with its neighbours, up to a number on each side. */
  struct Key {
    KeyNodeId id;
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

  /** Of a key node that is to be registered with another robot's. */
  Key ofStrangers(KeyNodeId id) const {
    const auto reach = static_cast<uint32_t>(options_.accumulate_neighbors);
    return {id, reach, reach};
  }

  /** Not while other threads get(). */
  void add(const KeyNodePacket& packet);
  /** The prepared scan, as of the key nodes added so far. Safe from many threads.
   *  \throws std::out_of_range if the key node was not added. */
  PreparedScanPtr get(const Key& key);

  PreparationReport report() const;

 private:
  struct KeyNode {
    Pose3 odom_T_base = Pose3::Identity();
    KeyedScanPtr scan;
    bool planar = false;
  };
  /** A scan that one thread prepares while others that want it wait. */
  struct Entry {
    size_t scans = 0;  ///< how many it is made of; out of date once members() has more
    std::once_flag once;
    PreparedScanPtr prepared;
    bool counted = false;  ///< in bytes_
    std::list<Key>::iterator use;
  };
  using EntryPtr = std::shared_ptr<Entry>;

  Key key(KeyNodeId id, const LoopClosureCandidate& candidate) const;
  /** The key nodes whose scans make up the prepared one. */
  std::vector<KeyNodeId> members(const Key& key) const;
  PreparedScanPtr prepare(const Key& key) const;
  EntryPtr find(const Key& key);
  void account(const Key& key, const EntryPtr& entry);
  void forget(std::map<Key, EntryPtr>::iterator entry);

  const PreparationOptions options_;
  std::unordered_map<KeyNodeId, KeyNode> key_nodes_;

  mutable std::mutex mutex_;  ///< of all that follows
  std::map<Key, EntryPtr> entries_;
  std::list<Key> uses_;  ///< last used first
  size_t bytes_ = 0;
  PreparationReport forgotten_;  ///< of scans that are no longer in memory
};

}  // namespace lamp
