#include "SwappedRobots.h"

#include <stdexcept>

#include "lamp/evaluation/Alignment.h"
#include "lamp/evaluation/TrajectoryError.h"

namespace lamp::evaluation {

namespace {

constexpr size_t kMinPoses = 10;
constexpr double kMinMisfit = 1.0;   ///< metres; below, a trajectory fits its truth anyway
constexpr double kMuchBetter = 3.0;  ///< times

double misfit(const std::vector<JoinedPose>& poses, bool planar) {
  return Statistics::of(trajectoryError(poses, fitRigid(poses, planar)).position_m).rmse;
}

/** The trajectory, joined with the truth of another robot. */
std::vector<JoinedPose> joinedWith(const TrueTrajectory& other,
                                   const std::vector<JoinedPose>& trajectory) {
  std::vector<JoinedPose> poses;
  for (JoinedPose pose : trajectory) {
    const auto truth = other.at(pose.stamp);
    if (!truth) continue;
    pose.truth = *truth;
    poses.push_back(pose);
  }
  return poses;
}

/** Whether the trajectory fits the other robot's truth much better than its own. */
bool fitsBetter(const NamedTrajectory& robot, const NamedTrajectory& other,
                const TruthFolder& truth) {
  const double own = misfit(*robot.poses, robot.robot.planar);
  if (own < kMinMisfit) return false;
  const TrueTrajectory path(readTum(truth.trajectory(other.robot.name)), robot.robot.planar);
  const std::vector<JoinedPose> poses = joinedWith(path, *robot.poses);
  if (poses.size() < kMinPoses || 2 * poses.size() < robot.poses->size()) return false;
  return own > kMuchBetter * misfit(poses, robot.robot.planar);
}

}  // namespace

void refuseSwappedRobots(const std::vector<NamedTrajectory>& robots, const TruthFolder& truth) {
  for (size_t i = 0; i < robots.size(); ++i)
    for (size_t j = 0; j < i; ++j)
      if (fitsBetter(robots[i], robots[j], truth) && fitsBetter(robots[j], robots[i], truth))
        throw std::runtime_error(
            "robots '" + robots[j].robot.name + "' and '" + robots[i].robot.name +
            "' each fit the other one's true trajectory much better than their "
            "own: were the files swapped?");
}

}  // namespace lamp::evaluation
