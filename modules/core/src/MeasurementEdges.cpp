#include "lamp/core/MeasurementEdges.h"

#include <Eigen/LU>

namespace lamp {

namespace {

double informationOf(double sigma) {
  return 1.0 / (sigma * sigma);
}

Edge unaryEdge(EdgeType type, KeyNodeId id) {
  Edge edge;
  edge.type = type;
  edge.from = edge.to = id;
  edge.information.setZero();
  if (edge.mayBeRejected()) edge.verdict = Verdict::kPending;
  return edge;
}

void setRange(Edge& edge, double range_m, double sigma_m) {
  edge.from_T_to.translation().x() = range_m;
  edge.information(0, 0) = informationOf(sigma_m);
}

}  // namespace

Edge gravityEdge(KeyNodeId id, const Eigen::Vector3d& base_up, double sigma_rad) {
  Edge edge = unaryEdge(EdgeType::kGravity, id);
  const Eigen::Vector3d up = base_up.normalized();
  edge.from_T_to.linear() =
      Eigen::Quaterniond::FromTwoVectors(up, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  edge.information.bottomRightCorner<3, 3>() =
      informationOf(sigma_rad) * (Eigen::Matrix3d::Identity() - up * up.transpose());
  return edge;
}

Edge positionEdge(KeyNodeId id, LandmarkIndex landmark, const Eigen::Vector3d& from_p_landmark,
                  const Eigen::Matrix3d& covariance) {
  Edge edge = unaryEdge(EdgeType::kPosition, id);
  edge.landmark = landmark;
  edge.from_T_to.translation() = from_p_landmark;
  const Eigen::Matrix3d information = covariance.inverse();
  edge.information.topLeftCorner<3, 3>() = 0.5 * (information + information.transpose());
  return edge;
}

Edge bearingRangeEdge(KeyNodeId id, LandmarkIndex landmark, const Eigen::Vector3d& from_p_sensor,
                      const Eigen::Vector3d& from_p_landmark, std::optional<double> sigma_rad,
                      std::optional<double> sigma_m) {
  Edge edge = unaryEdge(EdgeType::kBearingRange, id);
  edge.landmark = landmark;
  edge.from_p_sensor = from_p_sensor;
  edge.from_T_to.translation() = from_p_landmark;
  const Eigen::Vector3d way = from_p_landmark - from_p_sensor, direction = way.normalized();
  const Eigen::Matrix3d along = direction * direction.transpose();
  auto information = edge.information.topLeftCorner<3, 3>();
  if (sigma_m) information += informationOf(*sigma_m) * along;
  if (sigma_rad)
    information += informationOf(*sigma_rad * way.norm()) * (Eigen::Matrix3d::Identity() - along);
  return edge;
}

Edge rangeEdge(KeyNodeId id, LandmarkIndex landmark, const Eigen::Vector3d& from_p_sensor,
               double range_m, double sigma_m) {
  Edge edge = unaryEdge(EdgeType::kRange, id);
  edge.landmark = landmark;
  edge.from_p_sensor = from_p_sensor;
  setRange(edge, range_m, sigma_m);
  return edge;
}

Edge robotRangeEdge(KeyNodeId from, const Eigen::Vector3d& from_p_sensor, KeyNodeId to,
                    const Eigen::Vector3d& to_p_sensor, double range_m, double sigma_m) {
  Edge edge = unaryEdge(EdgeType::kRobotRange, from);
  edge.to = to;
  edge.from_p_sensor = from_p_sensor;
  edge.to_p_sensor = to_p_sensor;
  setRange(edge, range_m, sigma_m);
  return edge;
}

}  // namespace lamp
