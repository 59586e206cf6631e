#include "MapViews.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace lamp {

namespace {

using Eigen::Vector3f;
using Cell = std::array<int, 3>;

/** Edge of the cells that tell floors from free space: coarser than maps are sampled. */
constexpr float kCell_m = 0.5f;
/** Free cells above a floor: what a robot and its sensor need. */
constexpr int kFreeCells = 3;
/** How many cells to each side tell how open a place is. */
constexpr int kOpenCells = 3;

Cell cellOf(const Vector3f& point) {
  return {static_cast<int>(std::floor(point.x() / kCell_m)),
          static_cast<int>(std::floor(point.y() / kCell_m)),
          static_cast<int>(std::floor(point.z() / kCell_m))};
}

bool isFree(const std::set<Cell>& filled, int x, int y, int floor) {
  for (int up = 1; up <= kFreeCells; ++up)
    if (filled.count({x, y, floor + up})) return false;
  return true;
}

/** How many of the columns around are free above the floor, the place's own included. */
int openness(const std::set<Cell>& filled, const Cell& floor) {
  int open = 0;
  for (int x = -kOpenCells; x <= kOpenCells; ++x)
    for (int y = -kOpenCells; y <= kOpenCells; ++y)
      open += isFree(filled, floor[0] + x, floor[1] + y, floor[2]);
  return open;
}

/** Most open first. */
std::vector<Cell> floorsOf(const std::set<Cell>& filled) {
  std::vector<std::pair<int, Cell>> floors;
  for (const Cell& cell : filled)
    if (isFree(filled, cell[0], cell[1], cell[2]))
      floors.push_back({-openness(filled, cell), cell});
  std::sort(floors.begin(), floors.end());
  std::vector<Cell> cells;
  for (const auto& [open, cell] : floors) cells.push_back(cell);
  return cells;
}

}  // namespace

NearestRanges::NearestRanges(const std::vector<Vector3f>& points, const Vector3f& viewpoint)
    : viewpoint_(viewpoint) {
  for (const Vector3f& point : points) {
    const Vector3f ray = point - viewpoint_;
    float& range = nearest_.emplace(directionOf(ray), ray.norm()).first->second;
    range = std::min(range, ray.norm());
  }
}

bool NearestRanges::hides(const Vector3f& point) const {
  constexpr float kBehind = 1.5f, kBehind_m = 1.0f;
  const Vector3f ray = point - viewpoint_;
  const auto nearest = nearest_.find(directionOf(ray));
  return nearest != nearest_.end() && ray.norm() > kBehind * nearest->second + kBehind_m;
}

NearestRanges::Direction NearestRanges::directionOf(const Vector3f& ray) {
  constexpr float kEdge = 0.035f;
  const Vector3f direction = ray.normalized() / kEdge;
  return {static_cast<int>(std::floor(direction.x())), static_cast<int>(std::floor(direction.y())),
          static_cast<int>(std::floor(direction.z()))};
}

std::vector<Vector3f> standpoints(const std::vector<Vector3f>& map, float height_m, float spacing_m,
                                  size_t max) {
  std::set<Cell> filled;
  for (const Vector3f& point : map) filled.insert(cellOf(point));
  std::vector<Vector3f> places;
  for (const Cell& floor : floorsOf(filled)) {
    if (places.size() == max) break;
    const Vector3f place =
        kCell_m * Vector3f(static_cast<float>(floor[0]) + 0.5f, static_cast<float>(floor[1]) + 0.5f,
                           static_cast<float>(floor[2]) + 0.5f) +
        Vector3f(0, 0, height_m);
    if (std::all_of(places.begin(), places.end(),
                    [&](const Vector3f& other) { return (place - other).norm() >= spacing_m; }))
      places.push_back(place);
  }
  return places;
}

std::vector<Vector3f> visibleFrom(const Vector3f& viewpoint, const std::vector<Vector3f>& map,
                                  float range_m) {
  std::vector<Vector3f> near;
  for (const Vector3f& point : map)
    if ((point - viewpoint).norm() <= range_m) near.push_back(point);
  const NearestRanges ranges(near, viewpoint);
  near.erase(std::remove_if(near.begin(), near.end(),
                            [&](const Vector3f& point) { return ranges.hides(point); }),
             near.end());
  return near;
}

}  // namespace lamp
