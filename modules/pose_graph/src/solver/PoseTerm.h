#pragma once

#include <vector>

#include "lamp/core/PoseGraph.h"
#include "solver/PointErrors.h"
#include "solver/PoseSpaces.h"

namespace lamp {

/** An edge of the graph as the solvers see it: one term of the sum of squares. Landmarks are poses
 * after those of the key nodes; only their positions count. */
template <class Space>
struct PoseTerm {
  using Pose = typename Space::Pose;
  using Tangent = typename Space::Tangent;
  using Jacobian = typename Space::Jacobian;

  EdgeType type;
  size_t from, to;  ///< places in PoseGraph::nodes(), then landmarks(); the same if isUnary()
  Pose measured;
  Jacobian information;
  Eigen::Vector3d from_p_sensor, to_p_sensor;
  double weight = 1.0;

  /** It concerns `to` alone. */
  bool isUnary() const { return from == to; }

  /** Null pointers ask for no Jacobian. A unary term has only `d_to`. */
  Tangent error(const Pose& from_pose, const Pose& to_pose, Jacobian* d_from,
                Jacobian* d_to) const {
    switch (type) {
      case EdgeType::kOdometry:
      case EdgeType::kLoopClosure:
        break;
      case EdgeType::kPrior:
        return Space::priorError(measured, to_pose, d_to);
      case EdgeType::kGravity:
        return Space::gravityError(measured, to_pose, d_to);
      case EdgeType::kPosition:
      case EdgeType::kBearingRange:
        return sightingError(from_pose, to_pose, d_from, d_to);
      case EdgeType::kRange:
      case EdgeType::kRobotRange:
        return distanceError(from_pose, to_pose, d_from, d_to);
    }
    return Space::relativeError(measured, from_pose, to_pose, d_from, d_to);
  }

  /** Squared Mahalanobis distance, without the weight. */
  double chi2(const Pose& from_pose, const Pose& to_pose) const {
    const Tangent e = error(from_pose, to_pose, nullptr, nullptr);
    return e.dot(information * e);
  }

 private:
  static constexpr int kPositionDof = Space::kPositionDof;

  Tangent sightingError(const Pose& from_pose, const Pose& landmark, Jacobian* d_from,
                        Jacobian* d_to) const {
    const auto seen = Space::toLocal(from_pose, Space::position(landmark));
    Eigen::Vector3d error = seen.p - Space::position(measured);
    Eigen::Matrix3d d_seen = Eigen::Matrix3d::Identity();
    if (type == EdgeType::kBearingRange)
      error = bearingRangeError(Space::position(measured) - from_p_sensor, seen.p - from_p_sensor,
                                &d_seen);
    if (d_from) {
      d_from->setZero();
      d_from->template topRows<kPositionDof>() =
          (d_seen * seen.d_pose).template topRows<kPositionDof>();
    }
    if (d_to) {
      d_to->setZero();
      d_to->template topLeftCorner<kPositionDof, kPositionDof>() =
          (d_seen * Space::rotation(from_pose).transpose())
              .template topLeftCorner<kPositionDof, kPositionDof>();
    }
    Tangent result = Tangent::Zero();
    result.template head<kPositionDof>() = error.template head<kPositionDof>();
    return result;
  }

  Tangent distanceError(const Pose& from_pose, const Pose& to_pose, Jacobian* d_from,
                        Jacobian* d_to) const {
    const auto start = Space::toWorld(from_pose, from_p_sensor);
    const auto end = Space::toWorld(to_pose, to_p_sensor);
    Eigen::RowVector3d d_between;
    Tangent result = Tangent::Zero();
    result[0] = rangeError(Space::position(measured).x(), end.p - start.p, &d_between);
    if (d_from) {
      d_from->setZero();
      d_from->row(0) = -d_between * start.d_pose;
    }
    if (d_to) {
      d_to->setZero();
      d_to->row(0) = d_between * end.d_pose;
    }
    return result;
  }
};

/** One term for each edge, in their order. */
template <class Space>
std::vector<PoseTerm<Space>> poseTerms(const PoseGraph& graph) {
  std::vector<PoseTerm<Space>> terms;
  for (const Edge& edge : graph.edges()) {
    PoseTerm<Space> term{edge.type,
                         graph.place(edge.from),
                         graph.place(edge.to),
                         Space::fromPose3(normalized(edge.from_T_to)),
                         Space::information(edge.information),
                         edge.from_p_sensor,
                         edge.to_p_sensor};
    if (edge.endsAtLandmark()) {
      term.to = graph.nodes().size() + edge.landmark;
      // Poses in the plane have no height, but an antenna has.
      if (Space::kPositionDof == 2) {
        if (edge.type == EdgeType::kRange)
          term.to_p_sensor.z() = graph.landmarks()[edge.landmark].world_p.z();
        else
          term.from_p_sensor.z() = 0;
      }
    }
    terms.push_back(term);
  }
  return terms;
}

}  // namespace lamp
