#pragma once

#include <map>
#include <vector>

#include "lamp/core/KeyNodePacket.h"
#include "lamp/core/PoseGraph.h"
#include "lamp/input/RobotOptions.h"

namespace lamp {

/** Turns what robots measure besides odometry and lidar into edges: gravity, landmarks, distances
 * to beacons and to each other. */
class ExtraEdges {
 public:
  /** \param robots in the order of their ids. */
  ExtraEdges(const std::vector<RobotOptions>& robots, const std::vector<BeaconOptions>& beacons);

  /** \param extras in the frame of key node `id`, which is in the graph.
   * \param packets of all key nodes in the graph. \return whether the graph has new edges. */
  bool add(KeyNodeId id, const KeyNodeExtras& extras,
           const std::map<KeyNodeId, KeyNodePacket>& packets, PoseGraph& graph);

 private:
  /** A distance to a robot whose next key node has not arrived yet. */
  struct OpenRange {
    KeyNodeId from;
    RangeReading reading;
  };
  struct Carrier {
    RobotId robot;
    Eigen::Vector3d base_p_beacon;
  };

  bool close(const OpenRange& range, const std::map<KeyNodeId, KeyNodePacket>& packets,
             PoseGraph& graph) const;
  LandmarkIndex beacon(int id, PoseGraph& graph) const;

  std::map<int, Carrier> carriers_;  ///< robots, by their beacon's number
  std::map<int, Landmark> beacons_;  ///< of the ini, by number
  std::vector<OpenRange> open_;
};

}  // namespace lamp
