#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "lamp/core/Geometry.h"
#include "lamp/core/Ids.h"

namespace lamp {

enum class EdgeType {
  kOdometry,     ///< motion between consecutive key nodes of one robot
  kPrior,        ///< absolute pose of one key node in the world; `from == to`
  kLoopClosure,  ///< registration of two keyed scans
};
const char* toString(EdgeType type);

/** Whether a loop closure takes part in the map. Edges that may not be rejected are kInlier. */
enum class Verdict { kPending, kInlier, kOutlier };
const char* toString(Verdict verdict);

struct Node {
  KeyframeId id;
  double stamp = 0;                        ///< seconds, UTC
  Pose3 world_T_base = Pose3::Identity();  ///< the current estimate
  Pose3 odom_T_base = Pose3::Identity();   ///< dead reckoning since the robot's first scan
  bool planar = false;                     ///< moves in x, y and yaw only
};

/** Place of an edge in PoseGraph::edges(); never changes. */
using EdgeIndex = size_t;

struct Edge {
  EdgeType type = EdgeType::kOdometry;
  KeyframeId from, to;
  Pose3 from_T_to = Pose3::Identity();          ///< kPrior: world_T_base
  Matrix6d information = Matrix6d::Identity();  ///< tangent space at from_T_to
  Verdict verdict = Verdict::kInlier;
  double weight = 1.0;  ///< last weight given by the robust back end
  double chi2 = 0.0;    ///< squared Mahalanobis residual at the estimate
  bool pinned = false;  ///< an operator vouches for this loop closure

  bool mayBeRejected() const { return type == EdgeType::kLoopClosure && !pinned; }
  bool betweenRobots() const { return from.robot != to.robot; }
  bool active() const { return verdict != Verdict::kOutlier; }
};

/** Key nodes of all robots that trusted edges join, largest component first. */
struct Component {
  std::vector<KeyframeId> nodes;  ///< in KeyframeId order
  std::vector<RobotId> robots;    ///< in RobotId order
};

/** Typed pose graph of a team: any number of edges between the same nodes, any number of
 * components. Nodes and edges are kept in the order in which they came. */
class PoseGraph {
 public:
  /** \throws std::logic_error if the id is there already. */
  void addNode(const Node& node);
  /** \throws std::logic_error if an end is missing, or an edge that is no prior joins a node with
   *  itself; std::invalid_argument if measurement or information is not finite or not PSD. */
  EdgeIndex addEdge(const Edge& edge);

  const std::vector<Node>& nodes() const { return nodes_; }
  const std::vector<Edge>& edges() const { return edges_; }
  std::vector<Edge>& edges() { return edges_; }

  bool contains(KeyframeId id) const { return place_.count(id) != 0; }
  const Node& node(KeyframeId id) const { return nodes_[place(id)]; }
  Node& node(KeyframeId id) { return nodes_[place(id)]; }
  /** Place in nodes(). \throws std::out_of_range. */
  size_t place(KeyframeId id) const { return place_.at(id); }

  /** Key nodes of one robot in index order. */
  const std::vector<KeyframeId>& robotNodes(RobotId robot) const;
  std::vector<RobotId> robots() const;

  /** Where poses of both robots can be compared: one robot, two robots with a start pose, or robots
   * that loop closures have joined in an optimisation. */
  bool shareFrame(RobotId a, RobotId b) const;

  /** True if every node is planar (and there is one). */
  bool planar() const;

  /** Joined by odometry and by loop closures that are not rejected; priors do not join. Largest
   * first, ties by first id. */
  std::vector<Component> components() const;

 private:
  std::vector<Node> nodes_;
  std::vector<Edge> edges_;
  std::unordered_map<KeyframeId, size_t> place_;
  std::unordered_map<RobotId, std::vector<KeyframeId>> by_robot_;
};

}  // namespace lamp
