#include "ObservationUnpacker.h"

#include <mrpt/obs/CActionRobotMovement2D.h>
#include <mrpt/obs/CActionRobotMovement3D.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/CObservationRobotPose.h>

namespace lamp {
namespace {

using mrpt::obs::CActionCollection;
using mrpt::obs::CActionRobotMovement2D;
using mrpt::obs::CActionRobotMovement3D;
using mrpt::obs::CObservation;

/** Wheel odometry where there is some: a frame may hold several estimates of the same motion. */
CActionRobotMovement2D::Ptr planarAction(const CActionCollection& actions) {
  CActionRobotMovement2D::Ptr first;
  for (size_t i = 0;; ++i) {
    const auto action = actions.getActionByClass<CActionRobotMovement2D>(i);
    if (!action) return first;
    if (action->estimationMethod == CActionRobotMovement2D::emOdometry) return action;
    if (!first) first = action;
  }
}

mrpt::poses::CPose2D increment(const CActionRobotMovement2D& action) {
  if (action.estimationMethod == CActionRobotMovement2D::emOdometry || !action.poseChange) {
    return action.rawOdometryIncrementReading;
  }
  return action.poseChange->getMeanVal();
}

template <class Observations>
mrpt::system::TTimeStamp firstStamp(const Observations& observations) {
  for (const auto& o : observations) {
    if (o->timestamp != INVALID_TIMESTAMP) return o->timestamp;
  }
  return INVALID_TIMESTAMP;
}

/** `robot/` of the first label that has one, or empty. */
template <class Observations>
std::string robotPrefix(const Observations& observations) {
  for (const auto& o : observations) {
    const size_t slash = o->sensorLabel.find('/');
    if (slash != std::string::npos) return o->sensorLabel.substr(0, slash + 1);
  }
  return {};
}

}  // namespace

void ObservationUnpacker::push(const mrpt::serialization::CSerializable::Ptr& object) {
  if (const auto actions = std::dynamic_pointer_cast<CActionCollection>(object)) {
    pushActions(*actions);
  } else if (const auto frame = std::dynamic_pointer_cast<mrpt::obs::CSensoryFrame>(object)) {
    pushFrame(Frame(frame->begin(), frame->end()));
  } else if (const auto observation = std::dynamic_pointer_cast<CObservation>(object)) {
    pushFrame({observation});
  }
}

void ObservationUnpacker::finish() {
  emitHeldFrame();
  if (action_pending_ && action_stamp_ != INVALID_TIMESTAMP) emitOdometry(action_stamp_, "");
}

CObservation::Ptr ObservationUnpacker::pop() {
  if (ready_.empty()) return nullptr;
  auto observation = ready_.front();
  ready_.pop_front();
  return observation;
}

void ObservationUnpacker::pushActions(const CActionCollection& actions) {
  const auto spatial = actions.getActionByClass<CActionRobotMovement3D>();
  const auto planar = planarAction(actions);
  if (!spatial && !planar) return;
  const bool first_motion = !spatial_motion_ && !planar_motion_;
  (spatial ? spatial_motion_ : planar_motion_) = true;
  if (first_motion && !held_frame_.empty() && firstStamp(held_frame_) != INVALID_TIMESTAMP) {
    emitOdometry(firstStamp(held_frame_), robotPrefix(held_frame_));
  }
  emitHeldFrame();
  if (spatial) {
    spatial_pose_ = spatial_pose_ + spatial->poseChange.mean;
    action_stamp_ = spatial->timestamp;
  } else {
    planar_pose_ = planar_pose_ + increment(*planar);
    action_stamp_ = planar->timestamp;
  }
  action_pending_ = true;
}

void ObservationUnpacker::pushFrame(Frame frame) {
  emitHeldFrame();
  if (frame.empty()) return;
  if (!frame_seen_ && !action_pending_) {
    frame_seen_ = true;
    held_frame_ = std::move(frame);
    return;
  }
  frame_seen_ = true;
  if (action_pending_) {
    const TimeStamp stamp = firstStamp(frame);
    const TimeStamp odometry_stamp = stamp != INVALID_TIMESTAMP ? stamp : action_stamp_;
    if (odometry_stamp != INVALID_TIMESTAMP) emitOdometry(odometry_stamp, robotPrefix(frame));
  }
  for (const auto& observation : frame) emit(observation, action_stamp_);
}

void ObservationUnpacker::emitHeldFrame() {
  for (const auto& observation : held_frame_) emit(observation, INVALID_TIMESTAMP);
  held_frame_.clear();
}

void ObservationUnpacker::emitOdometry(TimeStamp stamp, const std::string& robot_prefix) {
  CObservation::Ptr reading;
  if (spatial_motion_) {
    auto pose = mrpt::obs::CObservationRobotPose::Create();
    pose->pose.mean = spatial_pose_;
    reading = pose;
  } else {
    auto odometry = mrpt::obs::CObservationOdometry::Create();
    odometry->odometry = planar_pose_;
    reading = odometry;
  }
  reading->timestamp = stamp;
  reading->sensorLabel = robot_prefix + "odometry";
  ready_.push_back(reading);
  action_pending_ = false;
}

void ObservationUnpacker::emit(const CObservation::Ptr& observation, TimeStamp fallback) {
  if (observation->timestamp == INVALID_TIMESTAMP) observation->timestamp = fallback;
  if (observation->timestamp == INVALID_TIMESTAMP) {
    ++without_stamp_;
    return;
  }
  ready_.push_back(observation);
}

}  // namespace lamp
