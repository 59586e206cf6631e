#pragma once

#include <functional>
#include <vector>

#include "CloudPoints.h"

namespace lamp {

/** Whether a point belongs into the cloud. */
using PointFilter = std::function<bool(const CloudPoint&)>;

/** Square columns of the frame of a map, so that its cloud is made piece by piece: memory does not
 * grow with the map. In the order in which the key nodes see them. */
class CloudTiles {
 public:
  struct Tile {
    double column = 0, row = 0;       ///< whole numbers: place along x and y
    std::vector<uint32_t> key_nodes;  ///< that have points in it or within the margin
  };

  /** \param map must outlive the tiles. \param margin_m around a tile. */
  CloudTiles(const ComponentMap& map, double side_m, double margin_m);

  const std::vector<Tile>& tiles() const { return tiles_; }
  double side() const { return side_m_; }
  bool isWithin(const Tile& tile, const Eigen::Vector3f& position) const;
  /** The points of a tile and of its margin, in key node order. Points that are not finite are left
   * out. */
  std::vector<CloudPoint> points(const Tile& tile, const PointFilter& filter) const;

 private:
  const ComponentMap& map_;
  const double side_m_, margin_m_;
  std::vector<Tile> tiles_;
};

}  // namespace lamp
