#include "lamp/frontend/GateCalibration.h"

#include <algorithm>
#include <cmath>

#include "PlatePose.h"
#include "ReflectorClusters.h"
#include "lamp/core/ChiSquare.h"
#include "lamp/core/Csv.h"

namespace lamp {

namespace {

using Eigen::Vector3d;

constexpr double kDegree = M_PI / 180.0;
constexpr size_t kPlates = 3;
constexpr size_t kMostRays = 600'000;
constexpr float kFarthest_m = 40.0f;
constexpr size_t kMostClusters = 30;
/** By how much the centroid of what is seen of a plate lies off its middle, as a share of its size.
 */
constexpr double kCentroidShare = 0.7;
/** The inertial unit is believed if it is mounted as the recording says. */
constexpr double kMostTiltRad = 5.0 * kDegree, kMostLeanRad = 45.0 * kDegree;
/** Edges are blurred by the width of beams; a plate of 1.5 times the size has 0.56. */
constexpr double kMostMisfit = 0.3;
constexpr double kConfidence = 0.999;
constexpr double kMostSigma_m = 0.2, kMostSigmaRad = 1.0 * kDegree;
constexpr int kRefinements = 5;

/** Which clusters are the plates, in their order. */
using Assignment = std::vector<size_t>;

double distance(const std::vector<Vector3d>& points, size_t i) {
  return (points[i] - points[(i + 1) % kPlates]).norm();
}

/** Of the triangle: what its corners lie off a line at least. */
double heightOf(const std::vector<Vector3d>& corners) {
  const double area = (corners[1] - corners[0]).cross(corners[2] - corners[0]).norm();
  return area / std::max({distance(corners, 0), distance(corners, 1), distance(corners, 2)});
}

std::vector<Vector3d> centroids(const std::vector<ReflectorCluster>& clusters,
                                const Assignment& assignment) {
  std::vector<Vector3d> result;
  for (const size_t i : assignment) result.push_back(clusters[i].centroid);
  return result;
}

std::vector<Assignment> assignments(const std::vector<ReflectorCluster>& clusters,
                                    const std::vector<Vector3d>& plates, double tolerance_m) {
  std::vector<Assignment> result;
  const size_t n = clusters.size();
  for (size_t i = 0; i < n * n * n; ++i) {
    const Assignment triple = {i / (n * n), i / n % n, i % n};
    if (triple[0] == triple[1] || triple[1] == triple[2] || triple[2] == triple[0]) continue;
    const std::vector<Vector3d> seen = centroids(clusters, triple);
    bool fits = true;
    for (size_t side = 0; side < kPlates; ++side)
      fits = fits && std::abs(distance(seen, side) - distance(plates, side)) <= tolerance_m;
    if (fits) result.push_back(triple);
  }
  return result;
}

double leanOf(const Pose3& world_T_base, const Vector3d& base_up) {
  return std::acos(std::clamp((world_T_base.linear() * base_up).z(), -1.0, 1.0));
}

/** Axes of the plates, which lie in one plane and stand upright in it. */
Eigen::Matrix3d plateAxes(const std::vector<Vector3d>& plates) {
  const Vector3d across = (plates[1] - plates[0]).cross(plates[2] - plates[0]).normalized();
  const Vector3d upright = std::abs(across.z()) < 0.9 ? Vector3d::UnitZ() : Vector3d::UnitX();
  const Vector3d level = upright.cross(across).normalized();
  Eigen::Matrix3d axes;
  axes << level, across.cross(level), across;
  return axes;
}

/** Tries assignments of clusters to plates. */
class PlateMatcher {
 public:
  PlateMatcher(const GateOptions& options, const std::vector<JudgedRay>& rays,
               std::optional<FeltUp> up)
      : plate_m_(options.plate_m),
        plates_(options.positions()),
        world_R_plate_(plateAxes(plates_)),
        rays_(rays),
        up_(std::move(up)) {}

  /** \param near points of the plates, base frame. \return none if the rays contradict it. */
  std::optional<StartPrior> match(std::vector<Vector3d> near) const {
    Pose3 pose = poseOfPoints(near, plates_);
    if (leanOf(pose, Vector3d::UnitZ()) > kMostLeanRad || isBehind(pose)) return std::nullopt;
    std::vector<PlateMiddle> seen;
    PlatePose result;
    for (int i = 0; i < kRefinements; ++i) {
      seen = middles(near, pose);
      if (seen.size() < kPlates) return std::nullopt;
      result = poseOfPlates(seen, plates_, upFor(pose), pose);
      pose = result.pose.world_T_base;
    }
    const bool fit = std::all_of(seen.begin(), seen.end(), [](const PlateMiddle& middle) {
      return middle.misfit <= kMostMisfit;
    });
    if (!fit || result.chi_square > chiSquareQuantile(kConfidence, result.degrees_of_freedom))
      return std::nullopt;
    return moved(result.pose);
  }

 private:
  /** Their order tells from where the plates are seen. */
  bool isBehind(const Pose3& world_T_base) const {
    return (world_T_base.translation() - plates_[0]).dot(world_R_plate_.col(2)) < 0;
  }

  std::optional<FeltUp> upFor(const Pose3& pose) const {
    return up_ && leanOf(pose, up_->base_up) <= kMostTiltRad ? up_ : std::nullopt;
  }

  /** Moved along the plates' plane to where all three fit the rays together. The covariance stays
   * that of the plates one by one, which is larger. */
  StartPrior moved(StartPrior pose) const {
    PlateFrame frame = frameAt(pose.world_T_base);
    for (const Vector3d& plate : plates_)
      frame.middles.push_back(pose.world_T_base.inverse() * plate);
    const auto together = plateMiddle(rays_, frame);
    if (!together) return pose;
    Vector3d off = frame.base_R_plate.transpose() * (together->position - frame.middles.front());
    off.z() = 0;
    pose.world_T_base.translation() -= world_R_plate_ * off;
    return pose;
  }

  PlateFrame frameAt(const Pose3& world_T_base) const {
    return {world_T_base.linear().transpose() * world_R_plate_, {}, plate_m_};
  }

  /** Of the plates that any rays hit. */
  std::vector<PlateMiddle> middles(const std::vector<Vector3d>& near,
                                   const Pose3& world_T_base) const {
    PlateFrame frame = frameAt(world_T_base);
    std::vector<PlateMiddle> result;
    for (const Vector3d& point : near) {
      frame.middles = {point};
      const auto middle = plateMiddle(rays_, frame);
      if (middle) result.push_back(*middle);
    }
    return result;
  }

  const double plate_m_;
  const std::vector<Vector3d> plates_;
  const Eigen::Matrix3d world_R_plate_;
  const std::vector<JudgedRay>& rays_;
  const std::optional<FeltUp> up_;
};

bool isSame(const Pose3& a, const Pose3& b) {
  const Pose3 difference = a.inverse() * b;
  return difference.translation().norm() < kMostSigma_m && rotationAngle(difference) < 5 * kDegree;
}

GateResult judged(const StartPrior& pose) {
  const Vector6d sigmas = pose.covariance.diagonal().cwiseSqrt();
  if (sigmas.head<3>().maxCoeff() <= kMostSigma_m && sigmas.tail<3>().maxCoeff() <= kMostSigmaRad)
    return {pose, ""};
  return {std::nullopt, "the plates tell the pose to " +
                            formatFixed(sigmas.head<3>().maxCoeff(), 2) + " m and " +
                            formatFixed(sigmas.tail<3>().maxCoeff() / kDegree, 1) +
                            " deg only: the robot stands too far away, or their triangle is too "
                            "small"};
}

}  // namespace

void GateOptions::visit(OptionVisitor& v) {
  v("plates", plates, 9, "m",
    "positions of the middles of three reflective plates in the world, [x y z x y z x y z], "
    "counterclockwise as the robots see them; they lie in one plane, upright");
  v("plate_m", plate_m, "m", "length of a plate's edges", kPositive);
  v("intensity_ratio", intensity_ratio, "",
    "a plate's intensity is at least this many times that of other surfaces as far away", {1});
  v("standing_s", standing_s, "s", "what is seen in this time, or while the robot stands, is used",
    kPositive);
  v("up_sigma_deg", up_sigma_deg, "deg",
    "standard deviation of roll and pitch by an inertial unit at rest: biases and mounting",
    kPositive);
}

std::vector<Vector3d> GateOptions::positions() const {
  std::vector<Vector3d> result;
  for (size_t i = 0; i + 2 < plates.size(); i += 3)
    result.emplace_back(plates[i], plates[i + 1], plates[i + 2]);
  return result;
}

void GateOptions::moveBy(const Vector3d& shift) {
  for (size_t i = 0; i < plates.size(); ++i) plates[i] += shift[static_cast<Eigen::Index>(i % 3)];
}

std::optional<std::string> faultOf(const GateOptions& gate) {
  const std::vector<Vector3d> plates = gate.positions();
  if (plates.size() != kPlates) return "must say where three plates are";
  for (size_t i = 0; i < kPlates; ++i)
    if (distance(plates, i) < 3 * gate.plate_m) return "must lie apart by three times their size";
  if (heightOf(plates) < gate.plate_m) return "lie on a line";
  return std::nullopt;
}

void GateCalibration::add(const Scan& scan) {
  if (!scan.hasIntensity() || ray_count_ > kMostRays) return;
  for (size_t i = 0; i < scan.size(); ++i) {
    const SensorOrigin& sensor = scan.sensors[scan.sensor[i]];
    const LidarRay ray{sensor.position.cast<float>(), scan.points[i], scan.intensity[i]};
    if (ray.range() > kFarthest_m) continue;
    rays_[sensor.label].push_back(ray);
    ++ray_count_;
  }
}

GateResult GateCalibration::solve() const {
  if (rays_.empty()) return {std::nullopt, "no lidar of the robot gives intensities"};
  std::vector<JudgedRay> rays;
  std::vector<Eigen::Vector3f> bright;
  for (const auto& [lidar, of_lidar] : rays_) {
    const std::vector<bool> shines = shining(of_lidar, options_.intensity_ratio);
    for (size_t i = 0; i < of_lidar.size(); ++i) {
      rays.push_back({of_lidar[i], shines[i]});
      if (shines[i]) bright.push_back(of_lidar[i].point);
    }
  }
  std::vector<ReflectorCluster> clusters = reflectorClusters(bright, options_.plate_m);
  const std::string seen =
      std::to_string(clusters.size()) + " reflectors of a plate's size are seen";
  if (clusters.size() < kPlates) return {std::nullopt, "only " + seen};
  std::stable_sort(clusters.begin(), clusters.end(),
                   [](const auto& a, const auto& b) { return a.points.size() > b.points.size(); });
  clusters.resize(std::min(clusters.size(), kMostClusters));

  std::optional<FeltUp> up;
  if (!force_.isZero()) up = FeltUp{force_.normalized(), options_.up_sigma_deg * kDegree};
  const PlateMatcher matcher(options_, rays, up);
  const auto tried = assignments(clusters, options_.positions(), kCentroidShare * options_.plate_m);
  std::optional<StartPrior> found;
  for (const Assignment& assignment : tried) {
    const auto pose = matcher.match(centroids(clusters, assignment));
    if (pose && found && !isSame(pose->world_T_base, found->world_T_base))
      return {std::nullopt, "the plates fit in two ways: other reflectors form the same triangle"};
    if (pose) found = pose;
  }
  if (found) return judged(*found);
  return {std::nullopt,
          seen + ", but no three of them lie, and look, as the plates do from before the gate"};
}

}  // namespace lamp
