#include "CloudTiles.h"

#include <cmath>
#include <map>
#include <set>

namespace lamp {

namespace {

using Place = std::pair<double, double>;

/** Calls `visit(point)` for the points of one key node that are finite, in the frame of the map. */
template <class Visit>
void forEachPointOf(const ComponentMap& map, uint32_t key_node, Visit&& visit) {
  const MapKeyNode& node = map.key_nodes[key_node];
  if (!node.scan) return;
  for (uint32_t i = 0; i < node.scan->size(); ++i) {
    const Eigen::Vector3d point = node.world_T_base * node.scan->points[i].cast<double>();
    if (point.allFinite()) visit(CloudPoint{point.cast<float>(), key_node, i});
  }
}

}  // namespace

CloudTiles::CloudTiles(const ComponentMap& map, double side_m, double margin_m)
    : map_(map), side_m_(side_m), margin_m_(margin_m) {
  std::map<Place, size_t> known;
  const auto placeOf = [&](double coordinate) { return std::floor(coordinate / side_m_); };
  for (uint32_t key_node = 0; key_node < map.key_nodes.size(); ++key_node) {
    std::set<Place> touched;
    forEachPointOf(map, key_node, [&](const CloudPoint& point) {
      for (const double dx : {-margin_m_, margin_m_})
        for (const double dy : {-margin_m_, margin_m_})
          touched.insert({placeOf(point.position.x() + dx), placeOf(point.position.y() + dy)});
    });
    for (const Place& place : touched) {
      const auto [found, is_new] = known.emplace(place, tiles_.size());
      if (is_new) tiles_.push_back({place.first, place.second, {}});
      tiles_[found->second].key_nodes.push_back(key_node);
    }
  }
}

bool CloudTiles::isWithin(const Tile& tile, const Eigen::Vector3f& position) const {
  return std::floor(position.x() / side_m_) == tile.column &&
         std::floor(position.y() / side_m_) == tile.row;
}

std::vector<CloudPoint> CloudTiles::points(const Tile& tile, const PointFilter& filter) const {
  const auto isNear = [&](double coordinate, double place) {
    return coordinate >= place * side_m_ - margin_m_ &&
           coordinate <= (place + 1) * side_m_ + margin_m_;
  };
  std::vector<CloudPoint> points;
  for (const uint32_t key_node : tile.key_nodes)
    forEachPointOf(map_, key_node, [&](const CloudPoint& point) {
      const bool near = isWithin(tile, point.position) ||
                        (margin_m_ > 0 && isNear(point.position.x(), tile.column) &&
                         isNear(point.position.y(), tile.row));
      if (near && filter(point)) points.push_back(point);
    });
  return points;
}

}  // namespace lamp
