#include "lamp/scans/Agreement.h"

#include <algorithm>
#include <cmath>

namespace lamp {

using Eigen::Vector3f;

namespace {

/** This many points give the shares to a hundredth. */
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
  const double reach_m = coarseness(source, target) * distance_m;
  Agreement result;
  double squares = 0;
  size_t on_own = 0;
  for (size_t k = 0; k < source.own().size(); k += stride) {
    const uint32_t i = source.own()[k];
    const Vector3f p = T * source.points()[i];
    const Vector3f normal = T.linear() * source.normals()[i];
    const auto is_alike = [&](size_t j) {
      return normal.dot(target.normals()[j]) >= kCosineOf45Degrees;
    };
    float squared;
    const size_t j = target.tree().nearest(p, static_cast<float>(reach_m), squared);
    if (j == KdTree::kNone) continue;
    on_own += target.tree().anyWithin(p, static_cast<float>(reach_m), [&](size_t other) {
      return target.isOwn(other) && is_alike(other);
    });
    if (!is_alike(j)) continue;
    const double along_normal = target.normals()[j].dot(p - target.points()[j]);
    squares += along_normal * along_normal;
    ++result.matches;
  }
  if (result.matches == 0) return result;
  result.overlap = static_cast<double>(on_own) /
                   static_cast<double>((source.own().size() + stride - 1) / stride);
  result.residual_m = std::sqrt(squares / static_cast<double>(result.matches));
  return result;
}

double shareInFreeSpace(const PreparedScan& scan, const PreparedScan& other,
                        const Pose3& other_T_scan, double margin_m) {
  const Eigen::Isometry3f T = other_T_scan.cast<float>();
  const auto scaled_margin_m = static_cast<float>(coarseness(scan, other) * margin_m);
  size_t free = 0, known = 0;
  const size_t stride = strideOf(scan);
  for (size_t k = 0; k < scan.own().size(); k += stride) {
    const uint32_t i = scan.own()[k];
    const FreeSpace::Place place = other.freeSpace().at(T * scan.points()[i], scaled_margin_m);
    known += place != FreeSpace::Place::kUnknown;
    free += place == FreeSpace::Place::kFree;
  }
  return known == 0 ? 0 : static_cast<double>(free) / static_cast<double>(known);
}

}  // namespace lamp
