#include "lamp/scans/Agreement.h"

#include <algorithm>
#include <cmath>

namespace lamp {

using Eigen::Vector3f;

namespace {

/** So many points tell the shares to a hundredth. */
constexpr size_t kPoints = 2000;

size_t strideOf(const PreparedScan& scan) {
  return std::max<size_t>(1, scan.own().size() / kPoints);
}

}  // namespace

Agreement agreement(const PreparedScan& source, const PreparedScan& target,
                    const Pose3& target_T_source, double distance_m) {
  const float kCosineOf45Degrees = std::sqrt(0.5f);
  const Eigen::Isometry3f T = target_T_source.cast<float>();
  const size_t stride = strideOf(source);
  Agreement result;
  double squares = 0;
  for (size_t k = 0; k < source.own().size(); k += stride) {
    const uint32_t i = source.own()[k];
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
  result.overlap = static_cast<double>(result.matches) /
                   static_cast<double>((source.own().size() + stride - 1) / stride);
  result.residual_m = std::sqrt(squares / static_cast<double>(result.matches));
  return result;
}

double shareInFreeSpace(const PreparedScan& scan, const PreparedScan& other,
                        const Pose3& other_T_scan, double margin_m) {
  const Eigen::Isometry3f T = other_T_scan.cast<float>();
  size_t free = 0, known = 0;
  const size_t stride = strideOf(scan);
  for (size_t k = 0; k < scan.own().size(); k += stride) {
    const uint32_t i = scan.own()[k];
    const FreeSpace::Place place =
        other.freeSpace().at(T * scan.points()[i], static_cast<float>(margin_m));
    known += place != FreeSpace::Place::kUnknown;
    free += place == FreeSpace::Place::kFree;
  }
  return known == 0 ? 0 : static_cast<double>(free) / static_cast<double>(known);
}

}  // namespace lamp
