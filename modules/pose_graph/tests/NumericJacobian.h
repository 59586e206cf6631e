#pragma once

namespace lamp {

/** Jacobian of `error(pose ⊞ d)` at d = 0 by central differences. */
template <class Space, class Error>
typename Space::Jacobian numericJacobian(const typename Space::Pose& pose, const Error& error) {
  constexpr double kStep = 1e-6;
  typename Space::Jacobian jacobian;
  for (int i = 0; i < Space::kDof; ++i) {
    const typename Space::Tangent d = kStep * Space::Tangent::Unit(i);
    jacobian.col(i) = (error(Space::plus(pose, d)) - error(Space::plus(pose, -d))) / (2.0 * kStep);
  }
  return jacobian;
}

}  // namespace lamp
