#include "lamp/scans/PreparedScan.h"

#include "lamp/core/SurfaceNormals.h"

namespace lamp {

using Eigen::Vector3f;

PreparedScanPtr prepareScan(std::vector<Vector3f> points, int normal_neighbors, bool planar) {
  auto prepared = std::make_shared<PreparedScan>();
  prepared->points = std::move(points);
  prepared->planar = planar;
  prepared->tree = std::make_unique<KdTree>(prepared->points);
  prepared->normals = surfaceNormals(prepared->points, *prepared->tree, normal_neighbors, planar);
  return prepared;
}

std::vector<Vector3f> accumulate(const std::vector<PlacedScan>& scans) {
  size_t total = 0;
  for (const PlacedScan& placed : scans) total += placed.scan->size();
  std::vector<Vector3f> points;
  points.reserve(total);
  for (const PlacedScan& placed : scans) {
    const Eigen::Isometry3f T = placed.target_T_scan.cast<float>();
    for (const Vector3f& p : placed.scan->points) points.push_back(T * p);
  }
  return points;
}

}  // namespace lamp
