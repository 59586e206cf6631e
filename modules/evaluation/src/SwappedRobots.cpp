#include "SwappedRobots.h"

#include <stdexcept>

#include "lamp/evaluation/Alignment.h"
#include "lamp/evaluation/TrajectoryError.h"

namespace lamp {

namespace {

constexpr size_t kMinPoses = 10;
constexpr double kMinMisfit = 1.0;   ///< metres; below, a trajectory fits its truth anyway
constexpr double kMuchBetter = 3.0;  ///< times

double misfit(const std::vector<JoinedPose>& poses, bool planar) {
  return Statistics::of(trajectoryError(poses, fitRigid(poses, planar)).position_m).rmse;
}

/** Whether the trajectory fits the other robot's truth much better than its own. */
bool fitsBetter(const NamedTrajectory& robot, const TrueTrajectory& other) {
  std::vector<JoinedPose> poses;
  for (JoinedPose pose : *robot.poses) {
    const auto truth = other.at(pose.stamp);
    if (!truth) continue;
    pose.truth = *truth;
    poses.push_back(pose);
  }
  if (poses.size() < kMinPoses || 2 * poses.size() < robot.poses->size()) return false;
  const double own = misfit(*robot.poses, robot.robot.planar);
  return own > kMinMisfit && own > kMuchBetter * misfit(poses, robot.robot.planar);
}

TrueTrajectory truthOf(const NamedTrajectory& robot, const TruthFolder& truth) {
  return TrueTrajectory(readTum(truth.trajectory(robot.robot.name)), robot.robot.planar);
}

}  // namespace

void refuseSwappedRobots(const std::vector<NamedTrajectory>& robots, const TruthFolder& truth) {
  for (size_t i = 0; i < robots.size(); ++i)
    for (size_t j = 0; j < i; ++j)
      if (fitsBetter(robots[i], truthOf(robots[j], truth)) &&
          fitsBetter(robots[j], truthOf(robots[i], truth)))
        throw std::runtime_error(
            "robots '" + robots[j].robot.name + "' and '" + robots[i].robot.name +
            "' each fit the other one's true trajectory much better than their "
            "own: were files exchanged?");
}

}  // namespace lamp
