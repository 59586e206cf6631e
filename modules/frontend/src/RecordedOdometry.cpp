#include "lamp/frontend/RecordedOdometry.h"

#include <Eigen/Eigenvalues>
#include <algorithm>

IMPLEMENTS_VIRTUAL_MRPT_OBJECT(OdometrySource, Stage, lamp)
IMPLEMENTS_MRPT_OBJECT(RecordedOdometry, lamp::OdometrySource, lamp)

namespace lamp {

void RecordedOdometry::observe(const InputObservation& observation) {
  if (!isOdometry(*observation.observation)) return;
  const auto reading = odometryFromObservation(*observation.observation);
  if (!reading) {
    ++not_finite_;
    return;
  }
  if (!readings_.empty() && reading->stamp <= readings_.back().stamp) {
    ++out_of_order_;
    return;
  }
  planar_ = planar_ && reading->planar;
  readings_.push_back(*reading);
}

bool RecordedOdometry::covers(double stamp) const {
  return !readings_.empty() && readings_.back().stamp >= stamp;
}

std::deque<OdometryReading>::const_iterator RecordedOdometry::atOrAfter(double stamp) const {
  const auto found =
      std::lower_bound(readings_.begin(), readings_.end(), stamp,
                       [](const OdometryReading& reading, double t) { return reading.stamp < t; });
  return found == readings_.end() ? readings_.end() - 1 : found;
}

Pose3 RecordedOdometry::poseAt(double stamp) {
  const auto after = atOrAfter(stamp);
  if (after == readings_.begin() || after->stamp < stamp) return after->odom_T_base;
  const auto before = after - 1;
  const Pose3 pose = interpolate(before->odom_T_base, after->odom_T_base,
                                 (stamp - before->stamp) / (after->stamp - before->stamp));
  return planar_ ? projectToPlane(pose) : pose;
}

std::optional<Matrix6d> RecordedOdometry::covarianceBetween(double begin, double end) {
  const auto first = atOrAfter(begin), last = atOrAfter(end);
  std::optional<Matrix6d> result;
  if (first->covariance && last->covariance && first->stamp < last->stamp) {
    const Pose3 motion = first->odom_T_base.inverse() * last->odom_T_base;
    const Matrix6d growth =
        *last->covariance - composeCovariance(*first->covariance, motion, Matrix6d::Zero());
    const Matrix6d symmetric = 0.5 * (growth + growth.transpose());
    const Eigen::SelfAdjointEigenSolver<Matrix6d> eigen(symmetric, Eigen::EigenvaluesOnly);
    if (eigen.eigenvalues().minCoeff() > 0)
      result = symmetric;
    else
      ++ignored_covariances_;
  }
  forgetBefore(begin);
  return result;
}

void RecordedOdometry::forgetBefore(double stamp) {
  while (readings_.size() > 2 && readings_[1].stamp <= stamp) readings_.pop_front();
}

std::vector<std::string> RecordedOdometry::warnings() const {
  std::vector<std::string> result;
  if (ignored_covariances_ > 0)
    result.push_back(
        "the recorded covariance of the odometry does not grow with the motion: it is "
        "ignored for " +
        std::to_string(ignored_covariances_) +
        " odometry edges, which use the motion model of [frontend]");
  if (not_finite_ > 0)
    result.push_back(std::to_string(not_finite_) +
                     " odometry readings were dropped: their poses are not finite");
  if (out_of_order_ > 0)
    result.push_back(std::to_string(out_of_order_) +
                     " odometry readings were dropped: their stamps do not increase");
  return result;
}

void registerAllClasses_lamp_frontend() {
  mrpt::rtti::registerClass(CLASS_ID(OdometrySource));
  mrpt::rtti::registerClass(CLASS_ID(RecordedOdometry));
}

}  // namespace lamp
