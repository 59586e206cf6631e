#include "lamp/scans/Agreement.h"

#include <cmath>

namespace lamp {

using Eigen::Vector3f;

Agreement agreement(const PreparedScan& source, const PreparedScan& target,
                    const Pose3& target_T_source, double distance_m) {
  const float kCosineOf45Degrees = std::sqrt(0.5f);
  const Eigen::Isometry3f T = target_T_source.cast<float>();
  Agreement result;
  double squares = 0;
  for (const uint32_t i : source.own()) {
    const Vector3f p = T * source.points()[i];
    float squared;
    const size_t j = target.tree().nearest(p, static_cast<float>(distance_m), squared);
    if (j == KdTree::kNone) continue;
    const Vector3f normal = T.linear() * source.normals()[i];
    const Vector3f& target_normal = target.normals()[j];
    if (normal.dot(target_normal) < kCosineOf45Degrees) continue;
    const double along_normal = target_normal.dot(p - target.points()[j]);
    squares += along_normal * along_normal;
    ++result.matches;
  }
  if (result.matches == 0) return result;
  result.overlap = static_cast<double>(result.matches) / static_cast<double>(source.own().size());
  result.residual_m = std::sqrt(squares / static_cast<double>(result.matches));
  return result;
}

double shareInFreeSpace(const PreparedScan& scan, const PreparedScan& other,
                        const Pose3& other_T_scan, double margin_m) {
  const Eigen::Isometry3f T = other_T_scan.cast<float>();
  size_t free = 0, known = 0;
  for (const uint32_t i : scan.own()) {
    const FreeSpace::Place place =
        other.freeSpace().at(T * scan.points()[i], static_cast<float>(margin_m));
    known += place != FreeSpace::Place::kUnknown;
    free += place == FreeSpace::Place::kFree;
  }
  return known == 0 ? 0 : static_cast<double>(free) / static_cast<double>(known);
}

}  // namespace lamp
