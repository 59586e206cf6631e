#pragma once

#include <string>

#include "lamp/maps/MapExporter.h"

namespace lamp {

/** The robot's name, or `robot <n>` where the table does not have it. */
std::string robotName(const ComponentMap& map, RobotId robot);

/** \throws std::runtime_error naming the key node or robot if a pose or loop is not finite,
 * or a keyed scan's fields differ in length or name no sensor. */
void checkMap(const ComponentMap& map);

/** The same rules for one scan. \param owner names the key node in the message. */
void checkScan(const Scan& scan, const std::string& owner);

/** Calls `visit(key_node, point index, world point)` for every point of every keyed scan, in key
 * node order. Points that are not finite are passed over. */
template <class Visitor>
void forEachPoint(const ComponentMap& map, Visitor&& visit) {
  for (const MapKeyNode& key_node : map.key_nodes) {
    if (!key_node.scan) continue;
    for (size_t i = 0; i < key_node.scan->size(); ++i) {
      const Eigen::Vector3d point =
          key_node.world_T_base * key_node.scan->points[i].template cast<double>();
      if (point.allFinite()) visit(key_node, i, point);
    }
  }
}

}  // namespace lamp
