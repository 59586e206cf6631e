#include "StandstillCheck.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "lamp/scans/Icp.h"
#include "lamp/scans/VoxelFilter.h"

namespace lamp {

namespace {

constexpr double kDegree = M_PI / 180.0;

/** Odometry that moves less stands. */
constexpr double kStandsM = 0.05, kStandsRad = 1.0 * kDegree;
/** A lidar that moves more does not. */
constexpr double kMovesM = 0.5, kMovesRad = 8.0 * kDegree;
/** Looks in a row that have to say so; one where each scan is a key node and must not be lost. */
constexpr int kVotes = 2;

/** A range has changed if it differs by more than this and this share. */
constexpr double kRangeM = 0.2, kRangeShare = 0.03;
constexpr double kMaxChanged = 0.1;
constexpr double kDirectionRad = 2.0 * kDegree;
constexpr size_t kFewestDirections = 50;

constexpr double kLeafM = 0.2;
constexpr int kNormalNeighbors = 10;

using Direction = std::pair<int, int>;

/** Nearest range in each direction, from the first lidar. */
std::map<Direction, double> ranges(const Scan& scan) {
  std::map<Direction, double> result;
  for (size_t i = 0; i < scan.size(); ++i) {
    if (scan.sensor[i] != 0) continue;
    const Eigen::Vector3d ray = scan.points[i].cast<double>() - scan.sensors[0].position;
    const double elevation = std::atan2(ray.z(), ray.head<2>().norm());
    const double azimuth = std::atan2(ray.y(), ray.x());
    const Direction direction(static_cast<int>(std::floor(elevation / kDirectionRad)),
                              static_cast<int>(std::floor(azimuth / kDirectionRad)));
    const auto [found, is_new] = result.emplace(direction, ray.norm());
    if (!is_new) found->second = std::min(found->second, ray.norm());
  }
  return result;
}

bool looksTheSame(const Scan& a, const Scan& b) {
  const auto before = ranges(a), now = ranges(b);
  size_t both = 0, changed = 0;
  for (const auto& [direction, range] : now) {
    const auto found = before.find(direction);
    if (found == before.end()) continue;
    ++both;
    const double most = kRangeM + kRangeShare * range;
    changed += std::abs(found->second - range) > most ? 1 : 0;
  }
  return both < kFewestDirections ||
         static_cast<double>(changed) <= kMaxChanged * static_cast<double>(both);
}

bool isPlanar(const std::vector<Eigen::Vector3f>& points) {
  return std::all_of(points.begin(), points.end(), [&](const Eigen::Vector3f& point) {
    return std::abs(point.z() - points.front().z()) < 0.01f;
  });
}

PreparedScanPtr prepare(const Scan& scan) {
  const Scan thinned = voxelFilter(scan, kLeafM);
  return prepareScan(thinned.points, kNormalNeighbors, isPlanar(thinned.points));
}

}  // namespace

bool StandstillCheck::contradicts(double stamp, const Pose3& odom_T_base,
                                  const std::function<Scan()>& scan) {
  const Pose3 motion = pose_ ? Pose3(pose_->inverse() * odom_T_base) : Pose3::Identity();
  if (!pose_ || motion.translation().norm() > kStandsM || rotationAngle(motion) > kStandsRad) {
    pose_ = odom_T_base;
    begin_ = last_look_ = stamp;
    reference_.reset();
    votes_ = 0;
    contradicted_ = false;
    if (interval_s_ > 0) return false;
  }
  if (!contradicted_ && stamp - last_look_ >= interval_s_) look(stamp, scan());
  return contradicted_;
}

void StandstillCheck::look(double stamp, Scan scan) {
  last_look_ = stamp;
  if (scan.points.empty()) return;
  if (!reference_) {
    reference_ = Look{stamp, std::move(scan), nullptr};
    return;
  }
  const double moved = looksTheSame(reference_->scan, scan) ? 0 : motionSince(*reference_, scan);
  votes_ = moved > 0 ? votes_ + 1 : 0;
  contradicted_ = votes_ >= (interval_s_ > 0 ? kVotes : 1);
  if (contradicted_) speed_ = moved / (stamp - reference_->stamp);
}

/** Metres; zero if it is too little to tell. */
double StandstillCheck::motionSince(Look& reference, const Scan& scan) const {
  if (!reference.prepared) reference.prepared = prepare(reference.scan);
  const PreparedScanPtr now = prepare(scan);
  const IcpResult result =
      icp(*now, *reference.prepared, Pose3::Identity(), IcpMetric::kPlaneToPlane, IcpOptions());
  const double length = result.target_T_source.translation().norm();
  const double angle = rotationAngle(result.target_T_source);
  return length > kMovesM || angle > kMovesRad ? std::max(length, kMovesM) : 0;
}

}  // namespace lamp
