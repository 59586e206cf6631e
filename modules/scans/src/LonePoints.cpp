#include "lamp/scans/LonePoints.h"

#include <unordered_map>

#include "GridCell.h"
#include "lamp/scans/Cloud.h"

namespace lamp {

namespace {

using Counts = std::unordered_map<GridCell, int, GridCellHash>;

bool hasNeighbor(const GridCell& cell, const Counts& counts) {
  for (int64_t x = -1; x <= 1; ++x)
    for (int64_t y = -1; y <= 1; ++y)
      for (int64_t z = -1; z <= 1; ++z) {
        const auto found = counts.find({cell.x + x, cell.y + y, cell.z + z});
        const bool own = x == 0 && y == 0 && z == 0;
        if (found != counts.end() && found->second > (own ? 1 : 0)) return true;
      }
  return false;
}

}  // namespace

Scan withoutLonePoints(const Scan& scan, double cell_m) {
  Counts counts;
  for (const Eigen::Vector3f& point : scan.points)
    if (isUsable(point)) ++counts[cellOf(point, cell_m)];
  Scan rest;
  rest.sensors = scan.sensors;
  for (size_t i = 0; i < scan.size(); ++i) {
    if (!isUsable(scan.points[i]) || !hasNeighbor(cellOf(scan.points[i], cell_m), counts)) continue;
    rest.points.push_back(scan.points[i]);
    if (scan.hasIntensity()) rest.intensity.push_back(scan.intensity[i]);
    if (scan.hasTimes()) rest.time.push_back(scan.time[i]);
    rest.sensor.push_back(scan.sensor[i]);
  }
  return rest;
}

}  // namespace lamp
