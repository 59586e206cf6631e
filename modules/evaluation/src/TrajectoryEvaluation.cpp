#include "lamp/evaluation/TrajectoryEvaluation.h"

#include <filesystem>
#include <stdexcept>

#include "SwappedRobots.h"
#include "lamp/core/Csv.h"

namespace lamp::evaluation {

namespace {

std::string percent(size_t part, size_t whole) {
  return formatFixed(100.0 * static_cast<double>(part) / static_cast<double>(whole), 1) + " %";
}

TrajectoryScore score(const JoinedTrajectory& joined, const Pose3& truth_T_estimate) {
  TrajectoryScore result;
  result.error = trajectoryError(joined.poses, truth_T_estimate);
  result.drift_10m = drift(joined.poses, 10);
  result.drift_100m = drift(joined.poses, 100);
  result.estimated = joined.estimated;
  result.joined = joined.poses.size();
  result.true_poses = joined.true_poses;
  result.true_poses_met = joined.true_poses_met;
  return result;
}

/** Result and odometry of one robot, joined but not yet aligned. */
struct JoinedRobot {
  RunFiles::Robot robot;
  double mean_true_height_m = 0;
  JoinedTrajectory result, odometry;
};

double meanHeight(const std::vector<StampedPose>& poses) {
  double sum = 0;
  for (const StampedPose& pose : poses) sum += pose.pose.translation().z();
  return sum / static_cast<double>(poses.size());
}

JoinedRobot join(const RunFiles& run, const RunFiles::Robot& robot, const TruthFolder& truth) {
  std::vector<StampedPose> true_poses = readTum(truth.trajectory(robot.name));
  JoinedRobot joined{robot, meanHeight(true_poses), {}, {}};
  const TrueTrajectory path(std::move(true_poses), robot.planar);
  joined.result = joinInTime(readTum(run.folder.trajectory(robot.name)), path, robot.name);
  const std::string odometry = run.folder.odometryTrajectory(robot.name);
  if (std::filesystem::exists(odometry))
    joined.odometry = joinInTime(readTum(odometry), path, robot.name);
  return joined;
}

std::vector<Pose3> alignAll(Alignment alignment, const std::vector<JoinedRobot>& robots,
                            JoinedTrajectory JoinedRobot::*trajectory) {
  std::vector<AlignmentMember> members;
  for (const JoinedRobot& robot : robots)
    if (!(robot.*trajectory).poses.empty())
      members.push_back({&(robot.*trajectory).poses, robot.robot.component, robot.robot.planar});
  std::vector<Pose3> of_members = align(alignment, members), all;
  size_t member = 0;
  for (const JoinedRobot& robot : robots)
    all.push_back((robot.*trajectory).poses.empty() ? Pose3::Identity() : of_members[member++]);
  return all;
}

void warnOfGaps(const RobotEvaluation& robot, std::vector<std::string>& warnings) {
  const TrajectoryScore& s = robot.result;
  if (s.joined < s.estimated)
    warnings.push_back("robot '" + robot.name + "': the truth covers only " +
                       percent(s.joined, s.estimated) +
                       " of the run's scans; the rest is not scored");
  if (s.true_poses_met < s.true_poses)
    warnings.push_back("robot '" + robot.name + "': the run covers only " +
                       percent(s.true_poses_met, s.true_poses) + " of the true trajectory");
  if (robot.odometry_poses.empty())
    warnings.push_back("robot '" + robot.name + "' has no odometry trajectory in the run");
  if (robot.planar)
    warnings.push_back("robot '" + robot.name +
                       "' is mapped in the plane: z, roll and pitch of the truth are dropped");
}

RobotEvaluation evaluate(const JoinedRobot& joined, const Pose3& truth_T_world,
                         const Pose3& truth_T_odom) {
  RobotEvaluation robot;
  robot.name = joined.robot.name;
  robot.component = joined.robot.component;
  robot.planar = joined.robot.planar;
  robot.mean_true_height_m = joined.mean_true_height_m;
  robot.poses = joined.result.poses;
  robot.odometry_poses = joined.odometry.poses;
  robot.truth_T_world = truth_T_world;
  robot.truth_T_odom = truth_T_odom;
  robot.result = score(joined.result, truth_T_world);
  if (!robot.odometry_poses.empty()) robot.odometry = score(joined.odometry, truth_T_odom);
  return robot;
}

/** True trajectories of robots that the run does not have count as not met. */
void addMissingRobots(const RunFiles& run, const TruthFolder& truth, TrajectoryEvaluation& all) {
  for (const std::string& name : truth.robots()) {
    bool in_run = false;
    for (const RunFiles::Robot& robot : run.robots) in_run = in_run || robot.name == name;
    if (in_run) continue;
    all.result.true_poses += readTum(truth.trajectory(name)).size();
    all.warnings.push_back("the truth has a robot '" + name + "' that the run does not have");
  }
}

}  // namespace

void TrajectoryScore::append(const TrajectoryScore& other) {
  error.append(other.error);
  drift_10m.append(other.drift_10m);
  drift_100m.append(other.drift_100m);
  estimated += other.estimated;
  joined += other.joined;
  true_poses += other.true_poses;
  true_poses_met += other.true_poses_met;
}

TrajectoryEvaluation evaluateTrajectories(const RunFiles& run, const TruthFolder& truth,
                                          Alignment alignment) {
  TrajectoryEvaluation all;
  all.alignment = alignment;
  std::vector<JoinedRobot> joined;
  for (const RunFiles::Robot& robot : run.robots) {
    if (truth.has(robot.name))
      joined.push_back(join(run, robot, truth));
    else
      all.warnings.push_back("robot '" + robot.name + "' has no " + truth.trajectory(robot.name) +
                             " and is not scored");
  }
  if (joined.empty())
    throw std::runtime_error(
        "'" + truth.root() + "' has no true trajectory of a robot of '" + run.folder.root() +
        "': files are named <robot>.tum, the first robot is '" + run.robots.front().name + "'");
  std::vector<NamedTrajectory> named;
  for (const JoinedRobot& robot : joined) named.push_back({robot.robot, &robot.result.poses});
  refuseSwappedRobots(named, truth);

  const auto of_result = alignAll(alignment, joined, &JoinedRobot::result);
  const auto of_odometry = alignAll(alignment, joined, &JoinedRobot::odometry);
  for (size_t i = 0; i < joined.size(); ++i) {
    all.robots.push_back(evaluate(joined[i], of_result[i], of_odometry[i]));
    all.result.append(all.robots.back().result);
    all.odometry.append(all.robots.back().odometry);
    warnOfGaps(all.robots.back(), all.warnings);
  }
  addMissingRobots(run, truth, all);
  return all;
}

}  // namespace lamp::evaluation
