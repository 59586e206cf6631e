#include "rejection/LoopCycles.h"

#include <algorithm>

#include "solver/Information.h"

namespace lamp {

namespace {

RelativePose composed(const RelativePose& a, const RelativePose& b) {
  return {a.a_T_b * b.a_T_b, composeCovariance(a.covariance, b.a_T_b, b.covariance)};
}

}  // namespace

DirectedLoop directed(EdgeIndex index, const Edge& edge, bool planar) {
  const Matrix6d covariance = boundedCovariance(edge.information, planar);
  if (edge.from < edge.to) return {index, edge.from, edge.to, {edge.from_T_to, covariance}};
  const Matrix6d Ad = adjoint(edge.from_T_to);
  return {index, edge.to, edge.from, {edge.from_T_to.inverse(), Ad * covariance * Ad.transpose()}};
}

int nodesBetween(KeyNodeId a, KeyNodeId b) {
  return static_cast<int>(std::max(a.index, b.index) - std::min(a.index, b.index));
}

RelativePose otherWay(const DirectedLoop& a, const DirectedLoop& b, const OdometryChains& chains) {
  const RelativePose there = *chains.between(a.from, b.from), back = *chains.between(b.to, a.to);
  return composed(composed(there, b.measured), back);
}

double Closure::distance2() const {
  return mahalanobis2(error, covariance);
}

Closure cycle(const DirectedLoop& a, const DirectedLoop& b, const OdometryChains& chains) {
  const RelativePose other = otherWay(a, b, chains);
  return {logSE3(a.measured.a_T_b.inverse() * other.a_T_b),
          a.measured.covariance + other.covariance};
}

}  // namespace lamp
