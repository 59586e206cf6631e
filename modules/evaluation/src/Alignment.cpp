#include "lamp/evaluation/Alignment.h"

#include <Eigen/SVD>
#include <algorithm>
#include <map>
#include <stdexcept>

namespace lamp::evaluation {

namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kLeverOfOrientation = 0.01;  // metres

/** The rotation R that maximises trace(Rᵀ M). */
Matrix3d nearestRotation(const Matrix3d& M, bool planar) {
  if (planar) {
    const double yaw = std::atan2(M(1, 0) - M(0, 1), M(0, 0) + M(1, 1));
    return Eigen::AngleAxisd(yaw, Vector3d::UnitZ()).toRotationMatrix();
  }
  const Eigen::JacobiSVD<Matrix3d> svd(M, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Vector3d signs = Vector3d::Ones();
  if ((svd.matrixU() * svd.matrixV()).determinant() < 0) signs.z() = -1;
  return svd.matrixU() * signs.asDiagonal() * svd.matrixV().transpose();
}

Pose3 firstPoseFit(const JoinedPose& first) {
  return first.truth * first.estimate.inverse();
}

/** The joined poses of all robots of a component. */
std::vector<JoinedPose> together(const std::vector<const AlignmentMember*>& members) {
  std::vector<JoinedPose> poses;
  for (const AlignmentMember* member : members)
    poses.insert(poses.end(), member->poses->begin(), member->poses->end());
  return poses;
}

Pose3 alignComponent(Alignment alignment, const std::vector<const AlignmentMember*>& members) {
  if (alignment == Alignment::kFirst) return firstPoseFit(members.front()->poses->front());
  const bool planar = std::all_of(members.begin(), members.end(),
                                  [](const AlignmentMember* member) { return member->planar; });
  return fitRigid(together(members), planar);
}

}  // namespace

const char* toString(Alignment alignment) {
  switch (alignment) {
    case Alignment::kNone:
      return "none";
    case Alignment::kFirst:
      return "first";
    case Alignment::kTeam:
      return "team";
    case Alignment::kSe3:
      return "se3";
  }
  throw std::logic_error("toString: no such alignment");
}

const char* describe(Alignment alignment) {
  switch (alignment) {
    case Alignment::kNone:
      return "estimate and truth share a world frame, nothing is moved";
    case Alignment::kFirst:
      return "the first pose of each component's first robot is moved onto its true pose";
    case Alignment::kTeam:
      return "one rigid transform for all robots of a component, least squares";
    case Alignment::kSe3:
      return "one rigid transform per robot, least squares: hides errors between robots";
  }
  throw std::logic_error("describe: no such alignment");
}

Alignment alignmentFromText(const std::string& text) {
  for (const Alignment alignment :
       {Alignment::kNone, Alignment::kFirst, Alignment::kTeam, Alignment::kSe3})
    if (text == toString(alignment)) return alignment;
  throw std::runtime_error("--align '" + text + "': say none, first, team or se3");
}

Pose3 fitRigid(const std::vector<JoinedPose>& poses, bool planar) {
  Vector3d mean_estimate = Vector3d::Zero(), mean_truth = Vector3d::Zero();
  for (const JoinedPose& pose : poses) {
    mean_estimate += pose.estimate.translation() / static_cast<double>(poses.size());
    mean_truth += pose.truth.translation() / static_cast<double>(poses.size());
  }
  Matrix3d M = Matrix3d::Zero();
  for (const JoinedPose& pose : poses) {
    M += (pose.truth.translation() - mean_truth) *
         (pose.estimate.translation() - mean_estimate).transpose();
    M += kLeverOfOrientation * kLeverOfOrientation * pose.truth.linear() *
         pose.estimate.linear().transpose();
  }
  Pose3 truth_T_estimate = Pose3::Identity();
  truth_T_estimate.linear() = nearestRotation(M, planar);
  truth_T_estimate.translation() = mean_truth - truth_T_estimate.linear() * mean_estimate;
  return truth_T_estimate;
}

std::vector<Pose3> align(Alignment alignment, const std::vector<AlignmentMember>& robots) {
  std::vector<Pose3> transforms(robots.size(), Pose3::Identity());
  if (alignment == Alignment::kNone) return transforms;
  std::map<size_t, std::vector<const AlignmentMember*>> components;
  for (const AlignmentMember& robot : robots) components[robot.component].push_back(&robot);
  for (size_t i = 0; i < robots.size(); ++i)
    transforms[i] = alignment == Alignment::kSe3
                        ? fitRigid(*robots[i].poses, robots[i].planar)
                        : alignComponent(alignment, components.at(robots[i].component));
  return transforms;
}

}  // namespace lamp::evaluation
