#include "ReflectorClusters.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace lamp {

namespace {

constexpr double kBinRatio = 1.25;
constexpr double kUsualShare = 0.9;
/** Of all rays of a lidar: so many that plates are few among them. */
constexpr double kFewestShare = 0.1;
constexpr size_t kFewestPoints = 5;
/** Of the noise of ranges, as a share of a plate's size. */
constexpr double kMargin = 0.3;

using Cell = std::array<int, 3>;

int binOf(const LidarRay& ray) {
  return static_cast<int>(std::floor(std::log(std::max(ray.range(), 0.01f)) / std::log(kBinRatio)));
}

/** What `kUsualShare` of the rays stay below in the bin and as many beside it as give enough. */
float usualIntensity(const std::map<int, std::vector<float>>& bins, int bin, size_t fewest) {
  std::vector<float> values;
  const int widest = std::max(bin - bins.begin()->first, bins.rbegin()->first - bin);
  for (int reach = 1; reach <= std::max(1, widest); ++reach) {
    values.clear();
    for (auto it = bins.lower_bound(bin - reach); it != bins.upper_bound(bin + reach); ++it)
      values.insert(values.end(), it->second.begin(), it->second.end());
    if (values.size() >= fewest) break;
  }
  const auto place =
      static_cast<std::ptrdiff_t>(kUsualShare * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + place, values.end());
  return values[static_cast<size_t>(place)];
}

Cell cellOf(const Eigen::Vector3f& p, double edge_m) {
  return {static_cast<int>(std::floor(p.x() / edge_m)),
          static_cast<int>(std::floor(p.y() / edge_m)),
          static_cast<int>(std::floor(p.z() / edge_m))};
}

/** The points of all cells that touch this one, or one that touches it, and so on; takes them. */
std::vector<size_t> takeConnected(const Cell& first, std::map<Cell, std::vector<size_t>>& cells) {
  std::vector<size_t> members;
  std::vector<Cell> open = {first};
  while (!open.empty()) {
    const Cell cell = open.back();
    open.pop_back();
    const auto found = cells.find(cell);
    if (found == cells.end()) continue;
    members.insert(members.end(), found->second.begin(), found->second.end());
    cells.erase(found);
    for (int i = 0; i < 27; ++i)
      open.push_back({cell[0] + i % 3 - 1, cell[1] + i / 3 % 3 - 1, cell[2] + i / 9 - 1});
  }
  return members;
}

bool fitsPlate(const ReflectorCluster& cluster, double size_m) {
  const double most = (0.5 * std::sqrt(2.0) + kMargin) * size_m;
  return cluster.points.size() >= kFewestPoints &&
         std::all_of(cluster.points.begin(), cluster.points.end(), [&](const Eigen::Vector3f& p) {
           return (p.cast<double>() - cluster.centroid).norm() <= most;
         });
}

}  // namespace

std::vector<bool> shining(const std::vector<LidarRay>& rays, double ratio) {
  std::map<int, std::vector<float>> bins;
  for (const LidarRay& ray : rays) bins[binOf(ray)].push_back(ray.intensity);
  const auto fewest = static_cast<size_t>(kFewestShare * static_cast<double>(rays.size()));
  std::map<int, float> limits;
  for (const auto& [bin, values] : bins)
    limits[bin] = static_cast<float>(ratio) * usualIntensity(bins, bin, fewest);
  std::vector<bool> result;
  for (const LidarRay& ray : rays) result.push_back(ray.intensity > limits.at(binOf(ray)));
  return result;
}

std::vector<ReflectorCluster> reflectorClusters(const std::vector<Eigen::Vector3f>& points,
                                                double size_m) {
  std::map<Cell, std::vector<size_t>> cells;
  for (size_t i = 0; i < points.size(); ++i) cells[cellOf(points[i], 0.5 * size_m)].push_back(i);
  std::vector<ReflectorCluster> clusters;
  for (const Eigen::Vector3f& point : points) {
    const std::vector<size_t> members = takeConnected(cellOf(point, 0.5 * size_m), cells);
    if (members.empty()) continue;
    ReflectorCluster cluster;
    for (const size_t i : members) {
      cluster.points.push_back(points[i]);
      cluster.centroid += points[i].cast<double>() / static_cast<double>(members.size());
    }
    if (fitsPlate(cluster, size_m)) clusters.push_back(std::move(cluster));
  }
  return clusters;
}

}  // namespace lamp
