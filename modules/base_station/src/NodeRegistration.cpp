#include "lamp/base_station/NodeRegistration.h"

#include <Eigen/LU>

namespace lamp {

void registerNode(const KeyNodePacket& packet, PoseGraph& graph) {
  Node node;
  node.id = packet.id;
  node.stamp = packet.stamp;
  node.odom_T_base = packet.odom_T_base;
  node.planar = packet.planar;
  const KeyNodeId previous{packet.id.robot, packet.id.index - 1};
  if (packet.odometry)
    node.world_T_base =
        normalized(graph.node(previous).world_T_base * packet.odometry->previous_T_this);
  else if (packet.prior)
    node.world_T_base = packet.prior->world_T_base;
  graph.addNode(node);

  Edge edge;
  edge.to = packet.id;
  if (packet.odometry) {
    edge.type = EdgeType::kOdometry;
    edge.from = previous;
    edge.from_T_to = packet.odometry->previous_T_this;
    edge.information = packet.odometry->covariance.inverse();
    graph.addEdge(edge);
  } else if (packet.prior) {
    edge.type = EdgeType::kPrior;
    edge.from = packet.id;
    edge.from_T_to = packet.prior->world_T_base;
    edge.information = packet.prior->covariance.inverse();
    graph.addEdge(edge);
  }
}

}  // namespace lamp
