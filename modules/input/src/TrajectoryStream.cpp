#include "TrajectoryStream.h"

#include <mrpt/obs/CObservationRobotPose.h>

#include "MrptPoses.h"
#include "lamp/core/Trajectory.h"

namespace lamp {

TrajectoryStream::TrajectoryStream(RobotId robot, const std::string& tum_file,
                                   RobotRegistry& registry)
    : robot_(robot), registry_(registry), poses_(readTum(tum_file)) {}

std::optional<double> TrajectoryStream::nextStamp() {
  if (next_ >= poses_.size()) return {};
  return poses_[next_].stamp;
}

InputObservation TrajectoryStream::pop() {
  const StampedPose& pose = poses_.at(next_++);
  auto observation = mrpt::obs::CObservationRobotPose::Create();
  observation->timestamp = mrpt::Clock::fromDouble(pose.stamp);
  observation->sensorLabel = "odometry_file";
  observation->pose.mean = poseToMrpt(pose.pose);
  registry_.label(robot_, observation->sensorLabel, *observation).use(pose.stamp);
  return {robot_, observation->sensorLabel, pose.stamp, observation};
}

double TrajectoryStream::progress() const {
  return static_cast<double>(next_) / static_cast<double>(poses_.size());
}

}  // namespace lamp
