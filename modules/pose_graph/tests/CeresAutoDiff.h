#pragma once

#include <ceres/ceres.h>
#include <ceres/rotation.h>

#include <array>
#include <cmath>
#include <vector>

#include "lamp/core/PoseGraph.h"

namespace lamp {

/** Our residual in space written down again, the straightforward way: quaternions, automatic
 * derivatives. */
class AutoDiffEdge3 {
 public:
  explicit AutoDiffEdge3(const Edge& edge) {
    const Eigen::Quaterniond q(edge.from_T_to.linear());
    measured_ = {q.w(), -q.x(), -q.y(), -q.z()};
    for (int i = 0; i < 3; ++i) translation_[i] = edge.from_T_to.translation()[i];
    root_ = edge.information.llt().matrixU();
  }

  template <class T>
  bool operator()(const T* to_q, const T* to_t, T* residual) const {
    const T q[4] = {T(1), T(0), T(0), T(0)}, t[3] = {T(0), T(0), T(0)};
    return (*this)(q, t, to_q, to_t, residual);
  }

  template <class T>
  bool operator()(const T* from_q, const T* from_t, const T* to_q, const T* to_t,
                  T* residual) const {
    const T inverse[4] = {from_q[0], -from_q[1], -from_q[2], -from_q[3]};
    const T difference[3] = {to_t[0] - from_t[0], to_t[1] - from_t[1], to_t[2] - from_t[2]};
    T moved[3], t[3], relative[4], q[4], w[3];
    const T measured[4] = {T(measured_[0]), T(measured_[1]), T(measured_[2]), T(measured_[3])};
    ceres::UnitQuaternionRotatePoint(inverse, difference, moved);
    for (int i = 0; i < 3; ++i) moved[i] -= translation_[i];
    ceres::UnitQuaternionRotatePoint(measured, moved, t);
    ceres::QuaternionProduct(inverse, to_q, relative);
    ceres::QuaternionProduct(measured, relative, q);
    ceres::QuaternionToAngleAxis(q, w);

    const T theta2 = ceres::DotProduct(w, w);
    const T theta = ceres::sqrt(theta2 + 1e-30);
    const T c =
        theta2 < T(1e-8)
            ? T(1.0 / 12.0)
            : (1.0 - 0.5 * theta * ceres::cos(0.5 * theta) / ceres::sin(0.5 * theta)) / theta2;
    T wt[3], wwt[3];
    ceres::CrossProduct(w, t, wt);
    ceres::CrossProduct(w, wt, wwt);
    Eigen::Matrix<T, 6, 1> error;
    for (int i = 0; i < 3; ++i) {
      error[i] = t[i] - 0.5 * wt[i] + c * wwt[i];
      error[3 + i] = w[i];
    }
    Eigen::Map<Eigen::Matrix<T, 6, 1>> whitened(residual);
    whitened = root_.cast<T>() * error;
    return true;
  }

 private:
  std::array<double, 4> measured_;
  std::array<double, 3> translation_;
  Matrix6d root_;
};

/** The residual in the plane, of [x y yaw] blocks. */
class AutoDiffEdge2 {
 public:
  explicit AutoDiffEdge2(const Edge& edge)
      : translation_(edge.from_T_to.translation().head<2>()), yaw_(yawOf(edge.from_T_to)) {
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) root_(i, j) = edge.information(kPlanarAxes[i], kPlanarAxes[j]);
    root_ = root_.llt().matrixU();
  }

  template <class T>
  bool operator()(const T* to, T* residual) const {
    const T from[3] = {T(0), T(0), T(0)};
    return (*this)(from, to, residual);
  }

  template <class T>
  bool operator()(const T* from, const T* to, T* residual) const {
    using std::atan2, std::cos, std::sin;
    const T c = cos(from[2]), s = sin(from[2]), x = to[0] - from[0], y = to[1] - from[1];
    const T dx = c * x + s * y - translation_.x(), dy = c * y - s * x - translation_.y();
    const double cm = std::cos(yaw_), sm = std::sin(yaw_);
    const T yaw = to[2] - from[2] - yaw_;
    const Eigen::Matrix<T, 3, 1> error(cm * dx + sm * dy, cm * dy - sm * dx,
                                       atan2(sin(yaw), cos(yaw)));
    Eigen::Map<Eigen::Matrix<T, 3, 1>> whitened(residual);
    whitened = root_.cast<T>() * error;
    return true;
  }

 private:
  Eigen::Vector2d translation_;
  double yaw_;
  Eigen::Matrix3d root_;
};

/** What one would write for Ceres without a second thought, for graphs with a prior. Loops that are
 * outliers take no part. \return the cost that `options` lead to from the current estimates. */
inline double solveWithAutoDiff(const PoseGraph& graph, ceres::Solver::Options options) {
  std::vector<std::array<double, 4>> q(graph.nodes().size());
  std::vector<std::array<double, 3>> t(graph.nodes().size());
  ceres::Problem problem;
  const bool planar = graph.planar();
  for (size_t i = 0; i < graph.nodes().size(); ++i) {
    const Pose3& pose = graph.nodes()[i].world_T_base;
    const Eigen::Quaterniond rotation(pose.linear());
    q[i] = {rotation.w(), rotation.x(), rotation.y(), rotation.z()};
    t[i] = {pose(0, 3), pose(1, 3), planar ? yawOf(pose) : pose(2, 3)};
    problem.AddParameterBlock(t[i].data(), 3);
    if (!planar) problem.AddParameterBlock(q[i].data(), 4, new ceres::QuaternionManifold);
  }
  using ceres::AutoDiffCostFunction;
  for (const Edge& edge : graph.edges()) {
    if (!edge.active()) continue;
    const size_t from = graph.place(edge.from), to = graph.place(edge.to);
    const bool prior = edge.type == EdgeType::kPrior;
    if (planar && prior)
      problem.AddResidualBlock(
          new AutoDiffCostFunction<AutoDiffEdge2, 3, 3>(new AutoDiffEdge2(edge)), nullptr,
          t[to].data());
    else if (planar)
      problem.AddResidualBlock(
          new AutoDiffCostFunction<AutoDiffEdge2, 3, 3, 3>(new AutoDiffEdge2(edge)), nullptr,
          t[from].data(), t[to].data());
    else if (prior)
      problem.AddResidualBlock(
          new AutoDiffCostFunction<AutoDiffEdge3, 6, 4, 3>(new AutoDiffEdge3(edge)), nullptr,
          q[to].data(), t[to].data());
    else
      problem.AddResidualBlock(
          new AutoDiffCostFunction<AutoDiffEdge3, 6, 4, 3, 4, 3>(new AutoDiffEdge3(edge)), nullptr,
          q[from].data(), t[from].data(), q[to].data(), t[to].data());
  }
  options.linear_solver_type = ceres::SPARSE_NORMAL_CHOLESKY;
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  return summary.final_cost;
}

}  // namespace lamp
