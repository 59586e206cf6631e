#include "MapSearch.h"

#include <algorithm>
#include <cmath>

#include "lamp/scans/GlobalAlignment.h"
#include "lamp/scans/PreparedScan.h"

namespace lamp {

namespace {

/** Scans are sought within this first, and never farther off than that, metres. */
constexpr double kNearM = 0.8, kMaxErrorM = 3.0;
/** Of a scan that is aligned without a guess. */
constexpr int kNormalNeighbors = 10;

/** Poses that no prediction is needed for: in space by descriptors; in the plane, turned from the
 * prediction. */
std::vector<Pose3> starts(const FilteredScan& scan, const Pose3& predicted,
                          const LocatedScan& reference) {
  std::vector<Pose3> result;
  if (scan.planar) {
    for (const double degrees : {15, -15, 30, -30, 45, -45, 60, -60})
      result.push_back(predicted * planarPose(0, 0, degrees * M_PI / 180.0));
    return result;
  }
  const PreparedScanPtr source = prepareScan(scan.points, kNormalNeighbors, false);
  const PreparedScanPtr target = prepareScan(reference.points, kNormalNeighbors, false);
  for (const GlobalPose& pose : alignByConsistency(source->features(), target->features(),
                                                   std::nullopt, ConsistencyOptions()))
    result.push_back(reference.odom_T_base * pose.target_T_source);
  return result;
}

}  // namespace

ScanToMapResult searchInMap(const FilteredScan& scan, const Pose3& predicted, double error_m,
                            double good_share, const LocatedScan* reference, LocalMap& map) {
  ScanToMapResult best = registerToMap(scan.points, map, predicted, std::min(kNearM, error_m));
  const auto look = [&](const Pose3& start, double error) {
    const ScanToMapResult other = registerToMap(scan.points, map, start, error);
    if (other.converged && (!best.converged || other.matched_share > best.matched_share))
      best = other;
  };
  const auto good = [&] { return best.converged && best.matched_share >= good_share; };
  if (!good() && error_m > kNearM) look(predicted, std::min(kMaxErrorM, error_m));
  if (!good() && reference && error_m > kNearM)
    for (const Pose3& start : starts(scan, predicted, *reference)) look(start, kNearM);
  return best;
}

}  // namespace lamp
