#include "lamp/core/G2oFile.h"

#include <algorithm>
#include <set>
#include <stdexcept>

#include "g2o/G2oEdgeLines.h"
#include "g2o/G2oNodes.h"
#include "g2o/G2oTravel.h"
#include "lamp/core/Files.h"
#include "lamp/core/TreeLayout.h"

namespace lamp {

namespace {

[[noreturn]] void refuse(const std::string& where, const std::string& why) {
  throw std::runtime_error(where + ": " + why);
}

/** Builds the graph from the lines. */
class Builder {
 public:
  Builder(const G2oLines& file, const OdometryEdges& choice) : file_(file), nodes_(file) {
    for (const G2oLine& line : file.lines)
      if (!line.is(G2oKind::kFixed) && line.tag->planar != isPlanar())
        refuse(file.where(line), "the file mixes SE2 and SE3");
    edges_ = telling(file, result_.notes);
    G2oTravel travel = travelOf(file, nodes_, edges_, choice);
    odometry_ = std::move(travel.odometry);
    result_.ids = std::move(travel.ids);
    result_.letters = std::move(travel.letters);
    result_.odometry = travel.rule;
    result_.information = informationKind(edges_);
  }

  G2oGraph build() {
    addNodes();
    addLandmarks();
    for (const G2oLine* line : edges_) {
      if (line->is(G2oKind::kRelativePose)) addRelativePose(*line);
      if (line->is(G2oKind::kSighting)) addSighting(*line);
    }
    placeNodes();
    placeLandmarks();
    for (const G2oLine* line : edges_)
      if (line->is(G2oKind::kPriorPose) || line->is(G2oKind::kPriorPosition)) addPrior(*line);
    return std::move(result_);
  }

 private:
  bool isPlanar() const {
    const auto first = std::find_if(file_.lines.begin(), file_.lines.end(),
                                    [](const G2oLine& l) { return !l.is(G2oKind::kFixed); });
    return first->tag->planar;
  }

  void addNodes() {
    std::vector<uint32_t> counts(result_.letters.size(), 0);
    for (const uint64_t id : result_.ids) {
      const auto robot = static_cast<size_t>(
          std::find(result_.letters.begin(), result_.letters.end(), letterOf(id)) -
          result_.letters.begin());
      const G2oNodes::Node& known = nodes_.poses().at(id);
      Node node;
      node.id = {RobotId{static_cast<uint16_t>(robot)}, counts[robot]++};
      if (known.vertex) node.world_T_base = known.vertex->pose;
      node.planar = isPlanar();
      node.fixed = known.fixed != nullptr;
      result_.graph.addNode(node);
      key_node_[id] = node.id;
    }
  }

  void addLandmarks() {
    for (const auto& [id, known] : nodes_.landmarks()) {
      Landmark landmark{std::to_string(id)};
      landmark.known = known.fixed != nullptr;
      landmark.placed = known.vertex != nullptr;
      if (known.vertex) landmark.world_p = known.vertex->pose.translation();
      result_.graph.addLandmark(landmark);
    }
  }

  void addRelativePose(const G2oLine& line) {
    const bool is_odometry = odometry_.count(&line) != 0;
    Edge edge = edgeOf(line, is_odometry ? EdgeType::kOdometry : EdgeType::kLoopClosure);
    edge.to = key_node_.at(line.ids[1]);
    if (!is_odometry) edge.verdict = Verdict::kPending;
    add(edge, line);
  }

  void addSighting(const G2oLine& line) {
    const Pose3 base_T_sensor = line.tag->planar ? Pose3::Identity() : nodes_.offset(line);
    Edge edge = edgeOf(line, EdgeType::kPosition);
    edge.landmark = *result_.graph.findLandmark(std::to_string(line.ids[1]));
    edge.from_T_to.translation() = base_T_sensor * line.pose.translation();
    const Matrix6d turn = adjoint(Pose3(Eigen::Quaterniond(base_T_sensor.linear())));
    edge.information = turn * line.information * turn.transpose();
    edge.verdict = Verdict::kPending;
    add(edge, line);
  }

  /** A position is a pose at the node's own rotation, about which it says nothing. */
  void addPrior(const G2oLine& line) {
    Edge edge = edgeOf(line, EdgeType::kPrior);
    Matrix6d to_file = Matrix6d::Identity();  // tangent at the node's pose to that at the line's
    if (line.is(G2oKind::kPriorPosition)) {
      edge.from_T_to.linear() = result_.graph.node(edge.from).world_T_base.linear();
      to_file.topLeftCorner<3, 3>() = edge.from_T_to.linear();
    } else if (!line.tag->planar) {
      const Pose3 sensor_T_base = nodes_.offset(line).inverse();
      edge.from_T_to = line.pose * sensor_T_base;
      to_file = adjoint(sensor_T_base);
    }
    edge.information = to_file.transpose() * line.information * to_file;
    add(edge, line);
  }

  Edge edgeOf(const G2oLine& line, EdgeType type) const {
    Edge edge;
    edge.type = type;
    edge.from = edge.to = key_node_.at(line.ids[0]);
    edge.from_T_to = line.pose;
    edge.information = line.information;
    return edge;
  }

  void add(const Edge& edge, const G2oLine& line) {
    try {
      result_.graph.addEdge(edge);
    } catch (const std::invalid_argument&) {
      refuse(file_.where(line), "the information matrix is not positive semi-definite");
    }
  }

  /** Those without VERTEX line: from their neighbours, or each component from its first node. */
  void placeNodes() {
    PoseGraph& graph = result_.graph;
    TreeLayout layout(graph);
    for (size_t i = 0; i < graph.nodes().size(); ++i)
      if (nodes_.poses().at(result_.ids[i]).vertex) layout.place(i, graph.nodes()[i].world_T_base);
    layout.spread();
    for (size_t i = 0; i < graph.nodes().size(); ++i) {
      if (!layout.placed(i)) layout.place(i, Pose3::Identity());
      layout.spread();
      if (!nodes_.poses().at(result_.ids[i]).vertex)
        graph.node(graph.nodes()[i].id).world_T_base = layout.poses()[i];
    }
  }

  /** Those without VERTEX line where the first sighting puts them. */
  void placeLandmarks() {
    for (const Edge& edge : result_.graph.edges()) {
      if (!edge.endsAtLandmark()) continue;
      Landmark& landmark = result_.graph.landmarks()[edge.landmark];
      if (landmark.placed) continue;
      landmark.world_p = result_.graph.node(edge.from).world_T_base * edge.from_T_to.translation();
      landmark.placed = true;
    }
  }

  const G2oLines& file_;
  const G2oNodes nodes_;
  std::vector<const G2oLine*> edges_;
  std::set<const G2oLine*> odometry_;
  std::map<uint64_t, KeyNodeId> key_node_;
  G2oGraph result_;
};

std::string knownTags(const std::map<std::string, size_t>& skipped) {
  std::string text;
  for (const auto& [tag, count] : skipped) text += (text.empty() ? ": " : ", ") + tag;
  return text.empty() ? "" : "; its lines begin with other words" + text.substr(0, 200);
}

}  // namespace

const char* toString(InformationKind kind) {
  switch (kind) {
    case InformationKind::kStated:
      return "stated";
    case InformationKind::kConstant:
      return "constant";
    case InformationKind::kIdentity:
      return "identity";
  }
  return "";
}

std::string G2oGraph::name(KeyNodeId id) const {
  const uint64_t number = ids.at(graph.place(id));
  const char letter = letters.at(id.robot.value);
  return letter ? letter + std::to_string(numberOf(number)) : std::to_string(number);
}

G2oGraph g2oFromText(const std::string& text, const std::string& name,
                     const OdometryEdges& odometry) {
  const G2oLines file = parseG2oLines(text, name);
  if (std::none_of(file.lines.begin(), file.lines.end(), [](const G2oLine& line) {
        return !line.is(G2oKind::kFixed) && !line.is(G2oKind::kOffset) &&
               !line.is(G2oKind::kLandmark);
      }))
    throw std::runtime_error(name + ": holds no line of a pose graph in g2o's format" +
                             knownTags(file.skipped));
  G2oGraph result = Builder(file, odometry).build();
  result.skipped = file.skipped;
  return result;
}

G2oGraph readG2oFile(const std::string& path, const OdometryEdges& odometry) {
  return g2oFromText(readTextFile(path), path, odometry);
}

}  // namespace lamp
