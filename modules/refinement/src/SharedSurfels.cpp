#include "lamp/refinement/SharedSurfels.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace lamp {

namespace {

using Eigen::Vector3d;

/** More points than this do not make the mean of a view better: the surface is rough. */
constexpr double kMostPoints = 5;
/** The distance between two views that has lost three quarters of its weight. */
constexpr double kKernel_m = 0.2;
/** Damping of a step, as a share of the weights: directions that nothing holds stay. */
constexpr double kDamping = 1e-3;

double precision(const SurfelView& a, const SurfelView& b) {
  const auto variance = [](const SurfelView& view) {
    return 1.0 / std::min<double>(view.points, kMostPoints);
  };
  return 2.0 / (kMostPoints * (variance(a) + variance(b)));
}

/** Calls `visit` with both elements of each pair of elements about one surfel. */
template <class Seen, class Visitor>
void forEachShared(const std::vector<Seen>& a, const std::vector<Seen>& b, const Visitor& visit) {
  for (auto i = a.begin(), j = b.begin(); i != a.end() && j != b.end();) {
    if (i->surfel < j->surfel)
      ++i;
    else if (j->surfel < i->surfel)
      ++j;
    else
      visit(*i++, *j++);
  }
}

}  // namespace

SharedSurfels::SharedSurfels(const std::vector<Surfel>& surfels, size_t nodes)
    : surfels_(surfels), seen_by_(nodes) {
  for (uint32_t s = 0; s < surfels.size(); ++s)
    for (const SurfelView& view : surfels[s].views) seen_by_[view.node].push_back({s, &view});
}

double SharedSurfels::share(size_t a, size_t b) const {
  size_t shared = 0;
  forEachShared(seen_by_[a], seen_by_[b], [&](const Seen&, const Seen&) { ++shared; });
  const size_t fewer = std::min(seen_by_[a].size(), seen_by_[b].size());
  return fewer == 0 ? 0 : static_cast<double>(shared) / static_cast<double>(fewer);
}

SharedSurfels::Step SharedSurfels::registration(size_t a, size_t b,
                                                const std::vector<Pose3>& world_T_node) const {
  const Pose3 a_T_b = world_T_node[a].inverse() * world_T_node[b];
  const Eigen::Matrix3d a_R_world = world_T_node[a].linear().transpose();
  Step result;
  MatchedSurface& surface = result.surface;
  Vector3d sum = Vector3d::Zero();
  double squared_radius = 0, squares = 0;
  forEachShared(seen_by_[a], seen_by_[b], [&](const Seen&, const Seen& in_b) {
    sum += a_T_b * in_b.view->node_p_mean;
    ++surface.patches;
  });
  if (surface.patches == 0) return result;
  surface.pivot = sum / surface.patches;
  Vector6d gradient = Vector6d::Zero();
  forEachShared(seen_by_[a], seen_by_[b], [&](const Seen& in_a, const Seen& in_b) {
    const Vector3d normal = a_R_world * surfels_[in_a.surfel].world_normal;
    const Vector3d p = a_T_b * in_b.view->node_p_mean;
    const Vector3d lever = p - surface.pivot;
    const double distance = normal.dot(p - in_a.view->node_p_mean);
    const double kernel = kKernel_m * kKernel_m / (kKernel_m * kKernel_m + distance * distance);
    const double weight = kernel * kernel * precision(*in_a.view, *in_b.view);
    Vector6d J;
    J << normal, lever.cross(normal);
    surface.information += weight * J * J.transpose();
    gradient += weight * distance * J;
    surface.weights += weight;
    squares += weight * distance * distance;
    squared_radius += lever.squaredNorm();
  });
  surface.radius_m = std::sqrt(squared_radius / surface.patches);
  surface.residual_m = std::sqrt(squares / surface.weights);
  Vector6d damping = Vector6d::Constant(kDamping * surface.weights);
  damping.tail<3>() *= surface.radius_m * surface.radius_m;
  const Matrix6d damped = surface.information + Matrix6d(damping.asDiagonal());
  const Vector6d motion = -damped.ldlt().solve(gradient);
  // From a motion about the pivot in the axes of a to one in the tangent space at the pose.
  result.step = adjoint(a_T_b.inverse() * Eigen::Translation3d(surface.pivot)) * motion;
  return result;
}

}  // namespace lamp
