#include "rejection/OdometryChains.h"

#include <unordered_map>

#include "solver/Information.h"

namespace lamp {

namespace {

constexpr double kFixedVariance = 1e-12;

/** A covariance at the end of `T`, seen from its start. */
Matrix6d carried(const Pose3& T, const Matrix6d& covariance) {
  const Matrix6d Ad = adjoint(T);
  return Ad * covariance * Ad.transpose();
}

}  // namespace

OdometryChains::OdometryChains(const PoseGraph& graph)
    : graph_(graph), links_(graph.nodes().size()) {
  for (const RobotId robot : graph.robots()) follow(robot);
  const auto addPrior = [&](KeyNodeId id, const Pose3& world_T_base, const Matrix6d& covariance) {
    const Link& link = links_[graph.place(id)];
    if (!priors_[link.chain])
      priors_[link.chain] = {world_T_base * link.first_T_node.inverse(),
                             carried(link.first_T_node, covariance)};
  };
  for (const Node& node : graph.nodes())
    if (node.fixed) addPrior(node.id, node.world_T_base, kFixedVariance * Matrix6d::Identity());
  for (const Edge& edge : graph.edges())
    if (edge.type == EdgeType::kPrior)
      addPrior(edge.from, edge.from_T_to, boundedCovariance(edge.information, graph.planar()));
}

void OdometryChains::follow(RobotId robot) {
  const bool planar = graph_.planar();
  struct Step {
    KeyNodeId to;
    RelativePose measured;
  };
  std::unordered_map<KeyNodeId, Step> steps;
  for (const Edge& edge : graph_.edges()) {
    if (edge.type != EdgeType::kOdometry || edge.from.robot != robot) continue;
    const Matrix6d covariance = boundedCovariance(edge.information, planar);
    if (edge.from < edge.to)
      steps[edge.from] = {edge.to, {edge.from_T_to, covariance}};
    else  // (T · Exp(d))⁻¹ = T⁻¹ · Exp(-Ad(T) d)
      steps[edge.to] = {edge.from, {edge.from_T_to.inverse(), carried(edge.from_T_to, covariance)}};
  }
  const Link* last = nullptr;
  const Step* step = nullptr;
  for (const KeyNodeId id : graph_.robotNodes(robot)) {
    Link& link = links_[graph_.place(id)];
    if (last && step && step->to == id) {
      link.chain = last->chain;
      link.first_T_node = normalized(last->first_T_node * step->measured.a_T_b);
      link.covariance = last->covariance + carried(link.first_T_node, step->measured.covariance);
    } else {
      link.chain = static_cast<int>(priors_.size());
      priors_.emplace_back();
      first_.push_back(id);
    }
    last = &link;
    const auto next = steps.find(id);
    step = next == steps.end() ? nullptr : &next->second;
  }
}

std::optional<RelativePose> OdometryChains::between(KeyNodeId a, KeyNodeId b, double scale) const {
  const Link& from = links_[graph_.place(a)];
  const Link& to = links_[graph_.place(b)];
  if (from.chain == to.chain) return withinChain(from, to, scale);
  if (!priors_[from.chain] || !priors_[to.chain]) return std::nullopt;
  return throughWorld(from, to, scale);
}

RelativePose OdometryChains::fromFirst(KeyNodeId id) const {
  const Link& link = links_[graph_.place(id)];
  return {link.first_T_node, carried(link.first_T_node.inverse(), link.covariance)};
}

RelativePose OdometryChains::withinChain(const Link& a, const Link& b, double scale) const {
  // The later node's sum includes the edges of the piece.
  const double sign = b.covariance.trace() >= a.covariance.trace() ? scale : -scale;
  return {a.first_T_node.inverse() * b.first_T_node,
          carried(b.first_T_node.inverse(), sign * (b.covariance - a.covariance))};
}

RelativePose OdometryChains::throughWorld(const Link& a, const Link& b, double scale) const {
  const Prior& a_prior = *priors_[a.chain];
  const Prior& b_prior = *priors_[b.chain];
  const Pose3 a_T_b =
      (a_prior.world_T_first * a.first_T_node).inverse() * (b_prior.world_T_first * b.first_T_node);
  const Matrix6d at_a =
      carried(a.first_T_node.inverse(), a_prior.covariance + scale * a.covariance);
  const Matrix6d at_b =
      carried(b.first_T_node.inverse(), b_prior.covariance + scale * b.covariance);
  return {a_T_b, at_b + carried(a_T_b.inverse(), at_a)};
}

}  // namespace lamp
