#include "lamp/evaluation/ScannedPoints.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <filesystem>
#include <map>

#include "lamp/core/PlyVertices.h"
#include "lamp/evaluation/KeyedScans.h"

namespace lamp::evaluation {

namespace {

using Points = std::vector<Eigen::Vector3f>;

constexpr float kSamePoint = 0.05f, kOfSurface = 0.3f, kOffSurface = 0.4f, kKeptWithin = 0.1f;

/** Returns from what moves, by the scan's place in the true trajectory. */
using MovingPoints = std::map<size_t, Points>;

MovingPoints readMoving(const std::string& path) {
  MovingPoints moving;
  if (!std::filesystem::exists(path)) return moving;
  PlyVertices(path).read({"scan", "x", "y", "z"}, [&](const double* v) {
    moving[static_cast<size_t>(v[0])].emplace_back(Eigen::Vector3d(v[1], v[2], v[3]).cast<float>());
  });
  return moving;
}

/** The row of a trajectory whose stamp is nearest. */
size_t rowAt(const std::vector<StampedPose>& poses, double stamp) {
  const auto after = std::lower_bound(poses.begin(), poses.end(), stamp,
                                      [](const StampedPose& p, double t) { return p.stamp < t; });
  if (after == poses.begin()) return 0;
  const auto before = after - 1;
  const bool later = after != poses.end() && after->stamp - stamp < stamp - before->stamp;
  return static_cast<size_t>((later ? after : before) - poses.begin());
}

/** Points of one scan. \param moving of the same scan. */
void tellApart(const Points& scan, const Points& moving, const Pose3& surface_T_true_base,
               const Pose3& surface_T_base, const TrueSurface& surface, ScannedPoints& result) {
  const KdTree movers(moving);
  const Eigen::Isometry3f true_pose = surface_T_true_base.cast<float>(),
                          pose = surface_T_base.cast<float>();
  for (const Eigen::Vector3f& point : scan) {
    float squared;
    const bool moves = movers.nearest(point, kSamePoint, squared) != KdTree::kNone;
    const float off = surface.distance(true_pose * point);
    if (moves && off <= kOffSurface) continue;
    (moves               ? result.moving
     : off <= kOfSurface ? result.fixed
                         : result.stray)
        .push_back(pose * point);
  }
}

void addRobot(const RunFiles& run, const RunFiles::Robot& robot, const TruthFolder& truth,
              const Pose3& surface_T_world, const TrueSurface& surface, ScannedPoints& result) {
  const std::string path = run.folder.keyNodes(robot.name);
  if (!std::filesystem::exists(path)) {
    result.notes.push_back("there is no '" + path + "': what the map keeps of it is unknown");
    return;
  }
  const KeyedScans scans = readKeyedScans(path);
  if (!scans.damage.empty()) result.notes.push_back(scans.damage);
  const TrueTrajectory true_way(readTum(truth.trajectory(robot.name)));
  const TrueTrajectory way(readTum(run.folder.keyNodeTrajectory(robot.name)));
  const MovingPoints moving = readMoving(truth.root() + "/" + robot.name + ".movers.ply");
  const Pose3 surface_T_truth(Eigen::Translation3d(-surface.samples().world_p_origin));
  for (const StampedPose& key_node : way.poses()) {
    const Points* scan = scans.at(key_node.stamp);
    const auto true_pose = true_way.at(key_node.stamp);
    if (!scan || !true_pose) continue;
    const auto found = moving.find(rowAt(true_way.poses(), key_node.stamp));
    tellApart(*scan, found == moving.end() ? Points() : found->second, surface_T_truth * *true_pose,
              surface_T_world * key_node.pose, surface, result);
  }
}

PointsKept keptOf(const Points& points, const KdTree& cloud) {
  using Range = tbb::blocked_range<size_t>;
  const size_t kept = tbb::parallel_reduce(
      Range(0, points.size()), size_t{0},
      [&](const Range& range, size_t sum) {
        float squared;
        for (size_t i = range.begin(); i < range.end(); ++i)
          sum += cloud.nearest(points[i], kKeptWithin, squared) != KdTree::kNone;
        return sum;
      },
      std::plus<>());
  return {points.size(), kept};
}

}  // namespace

ScannedPoints scannedPoints(const RunFiles& run, size_t component, const TruthFolder& truth,
                            const Pose3& surface_T_world, const TrueSurface& surface) {
  ScannedPoints result;
  for (const RunFiles::Robot& robot : run.robots)
    if (robot.component == component && truth.has(robot.name) && !robot.planar)
      addRobot(run, robot, truth, surface_T_world, surface, result);
  return result;
}

MapRemoval evaluateRemoval(const ScannedPoints& scanned, const Points& cloud) {
  const KdTree tree(cloud);
  return {keptOf(scanned.moving, tree), keptOf(scanned.fixed, tree), keptOf(scanned.stray, tree)};
}

}  // namespace lamp::evaluation
