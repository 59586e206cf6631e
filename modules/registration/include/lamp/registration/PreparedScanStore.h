#pragma once

#include <unordered_map>
#include <vector>

#include "lamp/core/KeyframePacket.h"
#include "lamp/core/Options.h"
#include "lamp/scans/PreparedScan.h"

namespace lamp {

struct PreparationOptions {
  int accumulate_neighbors = 2;
  int normal_neighbors = 10;

  void visit(OptionVisitor& v);
};

/** Keyed scans of all key nodes, and what registration computes from them once.
 *
 * A source is the key node's scan alone; a target is accumulated from the neighbours before and
 * after it, placed by odometry (paper II-C), so that optimisation does not invalidate it.
 */
class PreparedScanStore {
 public:
  enum class Role { kSource, kTarget };
  struct Key {
    KeyframeId id;
    Role role = Role::kSource;
    friend bool operator<(const Key& a, const Key& b) {
      return std::tie(a.id, a.role) < std::tie(b.id, b.role);
    }
  };

  explicit PreparedScanStore(const PreparationOptions& options) : options_(options) {}

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
  struct Keyframe {
    Pose3 odom_T_base = Pose3::Identity();
    KeyedScanPtr scan;
    bool planar = false;
  };
  struct KeyHash {
    size_t operator()(const Key& k) const {
      return std::hash<KeyframeId>()(k.id) * 2 + (k.role == Role::kTarget ? 1 : 0);
    }
  };
  struct KeyEqual {
    bool operator()(const Key& a, const Key& b) const { return a.id == b.id && a.role == b.role; }
  };
  struct Entry {
    PreparedScanPtr prepared;
    size_t scans = 0;  ///< how many scans it was made of
  };
  /** The key nodes whose scans make up the prepared one. */
  std::vector<KeyframeId> members(const Key& key) const;

  PreparationOptions options_;
  std::unordered_map<KeyframeId, Keyframe> keyframes_;
  std::unordered_map<Key, Entry, KeyHash, KeyEqual> entries_;
};

}  // namespace lamp
