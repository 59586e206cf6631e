#include "lamp/scans/PatchEvidence.h"

#include <cmath>
#include <map>

#include "GridCell.h"

namespace lamp {

namespace {

using Eigen::Vector3f;

constexpr double kPatch_m = 1.0;
/** How near a surface both scans have seen must lie, and how far before one free space ends; both
 * for scans of coarseness 1. */
constexpr double kPartner_m = 0.5, kMargin_m = 0.3;
/** A lone point is no surface. */
constexpr int kFewestPoints = 2;

/** The points of a patch, and what the other scan says of them. */
struct Counts {
  int points = 0, agreeing = 0, contradicting = 0;
};

/** A scan that is asked about the points of another one. */
class Witness {
 public:
  Witness(const PreparedScan& scan, double coarseness)
      : scan_(scan),
        partner_m_(static_cast<float>(kPartner_m * coarseness)),
        margin_m_(static_cast<float>(kMargin_m * coarseness)) {}

  bool hasSeen(const Vector3f& point, const Vector3f& normal) const {
    const float kCosineOf45Degrees = std::sqrt(0.5f);
    return scan_.tree().anyWithin(point, partner_m_, [&](size_t i) {
      return normal.dot(scan_.normals()[i]) >= kCosineOf45Degrees;
    });
  }
  /** Whether rays passed through the place, and did not just pass by the edge of something. */
  bool hasSeenThrough(const Vector3f& point) const {
    return scan_.freeSpace().at(point, margin_m_) == FreeSpace::Place::kFree &&
           !scan_.tree().anyWithin(point, margin_m_, [](size_t) { return true; });
  }

 private:
  const PreparedScan& scan_;
  const float partner_m_, margin_m_;
};

Patch patchOf(const Vector3f& point, double edge_m) {
  const GridCell cell = cellOf(point, edge_m);
  return {cell.x, cell.y, cell.z};
}

std::map<Patch, Counts> countPoints(const PreparedScan& scan, const Witness& witness,
                                    const Eigen::Isometry3f& other_T_scan) {
  std::map<Patch, Counts> patches;
  for (const uint32_t i : scan.own()) {
    Counts& counts = patches[patchOf(scan.points()[i], kPatch_m * scan.coarseness())];
    const Vector3f point = other_T_scan * scan.points()[i];
    ++counts.points;
    if (witness.hasSeen(point, other_T_scan.linear() * scan.normals()[i]))
      ++counts.agreeing;
    else if (witness.hasSeenThrough(point))
      ++counts.contradicting;
  }
  return patches;
}

}  // namespace

PatchEvidence patchEvidence(const PreparedScan& scan, const PreparedScan& other,
                            const Pose3& other_T_scan) {
  const Witness witness(other, coarseness(scan, other));
  PatchEvidence evidence;
  for (const auto& [patch, counts] : countPoints(scan, witness, other_T_scan.cast<float>())) {
    if (counts.points < kFewestPoints) continue;
    if (2 * counts.agreeing > counts.points) evidence.agreeing.push_back(patch);
    if (2 * counts.contradicting > counts.points) evidence.contradicting.push_back(patch);
  }
  return evidence;
}

}  // namespace lamp
