#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "lamp/core/Geometry.h"
#include "lamp/core/Ids.h"

namespace lamp {

/** What an edge measures. `from == to` where it concerns one key node, or one and a landmark. */
enum class EdgeType {
  kOdometry,      ///< motion between consecutive key nodes of one robot
  kPrior,         ///< absolute pose of one key node in the world
  kLoopClosure,   ///< registration of two keyed scans, or an operator's word
  kGravity,       ///< roll and pitch of one key node
  kPosition,      ///< of a landmark, seen from a key node
  kBearingRange,  ///< direction of a landmark and distance to it, or either
  kRange,         ///< distance to a landmark, such as a UWB anchor
  kRobotRange,    ///< distance between key nodes
};
const char* toString(EdgeType type);

/** Whether a loop closure takes part in the map. Edges that may not be rejected are kInlier. */
enum class Verdict { kPending, kInlier, kOutlier };
const char* toString(Verdict verdict);

struct Node {
  KeyNodeId id;
  double stamp = 0;                        ///< seconds, UTC
  Pose3 world_T_base = Pose3::Identity();  ///< the current estimate
  Pose3 odom_T_base = Pose3::Identity();   ///< dead reckoning since the robot's first scan
  bool planar = false;                     ///< moves in x, y and yaw only
  bool fixed = false;                      ///< surveyed: `world_T_base` is no estimate and stays
};

/** A place that robots see or measure distances to: an artifact, a radio anchor. */
struct Landmark {
  std::string name;
  Eigen::Vector3d world_p = Eigen::Vector3d::Zero();  ///< the current estimate
  bool known = false;   ///< surveyed: `world_p` is no estimate and stays
  bool placed = false;  ///< `world_p` means something
};

/** Place of an edge in PoseGraph::edges(); never changes. */
using EdgeIndex = size_t;
/** Place of a landmark in PoseGraph::landmarks(); never changes. */
using LandmarkIndex = size_t;

struct Edge {
  EdgeType type = EdgeType::kOdometry;
  KeyNodeId from, to;
  /** kPrior: world_T_base. kGravity: the same, of which the yaw does not count. kPosition,
   * kBearingRange: a translation, from_p_landmark. kRange, kRobotRange: a translation along x by
   * the distance. */
  Pose3 from_T_to = Pose3::Identity();
  /** Tangent space at from_T_to; zero in directions that the edge says nothing of. */
  Matrix6d information = Matrix6d::Identity();
  LandmarkIndex landmark = 0;  ///< the other end, if endsAtLandmark()
  /** Ranges and bearings: where in the frame of `from` (and `to`) they are measured. */
  Eigen::Vector3d from_p_sensor = Eigen::Vector3d::Zero();
  Eigen::Vector3d to_p_sensor = Eigen::Vector3d::Zero();
  Verdict verdict = Verdict::kInlier;
  double weight = 1.0;  ///< last weight given by the robust back end
  double chi2 = 0.0;    ///< squared Mahalanobis residual at the estimate
  bool pinned = false;  ///< an operator vouches for this loop closure

  /** The full relative pose of two key nodes. */
  bool joinsPoses() const { return type == EdgeType::kOdometry || type == EdgeType::kLoopClosure; }
  bool endsAtLandmark() const {
    return type == EdgeType::kPosition || type == EdgeType::kBearingRange ||
           type == EdgeType::kRange;
  }
  bool isLoopClosure() const { return type == EdgeType::kLoopClosure; }
  /** Loop closures but those that an operator vouches for; landmarks, which may be mistaken for one
   * another; distances, since radio may have taken a longer way. */
  bool mayBeRejected() const {
    return (isLoopClosure() && !pinned) || endsAtLandmark() || type == EdgeType::kRobotRange;
  }
  bool betweenRobots() const { return from.robot != to.robot; }
  bool active() const { return verdict != Verdict::kOutlier; }
};

/** Key nodes of all robots that trusted edges join, largest component first. */
struct Component {
  std::vector<KeyNodeId> nodes;  ///< in KeyNodeId order
  std::vector<RobotId> robots;   ///< in RobotId order
};

/** Typed pose graph of a team: any number of edges between the same nodes, any number of
 * components. Nodes and edges are kept in the order in which they came. */
class PoseGraph {
 public:
  /** \throws std::logic_error if the id already exists. */
  void addNode(const Node& node);
  /** \throws std::logic_error if an end is missing, or is the other where the type needs two key
   *  nodes; std::invalid_argument if measurement or information is not finite or not PSD. */
  EdgeIndex addEdge(const Edge& edge);
  /** \throws std::logic_error if the name already exists. */
  LandmarkIndex addLandmark(const Landmark& landmark);

  const std::vector<Node>& nodes() const { return nodes_; }
  const std::vector<Landmark>& landmarks() const { return landmarks_; }
  std::vector<Landmark>& landmarks() { return landmarks_; }
  /** By its name. */
  std::optional<LandmarkIndex> findLandmark(const std::string& name) const;
  const std::vector<Edge>& edges() const { return edges_; }
  std::vector<Edge>& edges() { return edges_; }

  bool contains(KeyNodeId id) const { return place_.count(id) != 0; }
  const Node& node(KeyNodeId id) const { return nodes_[place(id)]; }
  /** For its poses and stamp: `planar` and `fixed` stay as they were added. */
  Node& node(KeyNodeId id) { return nodes_[place(id)]; }
  /** Place in nodes(). \throws std::out_of_range. */
  size_t place(KeyNodeId id) const { return place_.at(id); }

  /** Key nodes of one robot in index order. */
  const std::vector<KeyNodeId>& robotNodes(RobotId robot) const;
  std::vector<RobotId> robots() const;

  /** Where poses of both robots can be compared: one robot, two robots with a start pose or a fixed
   * key node, or robots that loop closures have joined in an optimisation. */
  bool shareFrame(RobotId a, RobotId b) const;

  /** True if every node is planar (and there is one). */
  bool planar() const { return !nodes_.empty() && planar_nodes_ == nodes_.size(); }

  /** Joined by odometry and by loop closures that are not rejected; nothing else joins. Largest
   * first, ties by first id. */
  std::vector<Component> components() const;

 private:
  std::vector<Node> nodes_;
  std::vector<Edge> edges_;
  std::vector<Landmark> landmarks_;
  std::unordered_map<std::string, LandmarkIndex> landmark_by_name_;
  std::unordered_map<KeyNodeId, size_t> place_;
  std::unordered_map<RobotId, std::vector<KeyNodeId>> by_robot_;
  size_t planar_nodes_ = 0;
  std::set<RobotId> in_world_;  ///< robots with a prior or a fixed node
  /** Loop closures between two robots, by the robots. */
  std::map<std::pair<RobotId, RobotId>, std::vector<EdgeIndex>> between_robots_;
};

}  // namespace lamp
