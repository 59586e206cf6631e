#include <algorithm>

#include "GraphText.h"
#include "lamp/core/G2oFile.h"
#include "lamp/core/GraphFiles.h"

namespace lamp {

namespace {

/** Writes what a graph has beside relative poses. */
class G2oWriter {
 public:
  G2oWriter(const PoseGraph& graph, const std::vector<uint64_t>& ids)
      : graph_(graph),
        ids_(ids),
        planar_(graph.planar()),
        format_(planar_ ? kPlanarText : kQuaternionText) {}

  std::string text(bool with_priors) const {
    std::string text = nodeLines(graph_, format_, ids_) + fixedNodes(with_priors);
    text += edgeLines(graph_, format_, ids_);
    for (const Edge& edge : graph_.edges())
      if (with_priors && edge.type == EdgeType::kPrior) text += prior(edge);
    return text;
  }

  std::string landmarks() const {
    std::string text;
    for (const Landmark& landmark : graph_.landmarks()) {
      if (!landmark.placed) continue;
      text += std::string(planar_ ? "VERTEX_XY " : "VERTEX_TRACKXYZ ") + landmark.name +
              position(landmark.world_p) + "\n";
      if (landmark.known) text += "FIX " + landmark.name + "\n";
    }
    for (const Edge& edge : graph_.edges())
      if (edge.type == EdgeType::kPosition && edge.active()) text += sighting(edge);
    return text;
  }

  /** Number 0 is what priors and sightings refer to. */
  std::string parameters() const {
    const bool refers = std::any_of(
        graph_.edges().begin(), graph_.edges().end(),
        [](const Edge& e) { return e.type == EdgeType::kPrior || e.type == EdgeType::kPosition; });
    return refers && !planar_ ? "PARAMS_SE3OFFSET 0 0 0 0 0 0 0 1\n" : "";
  }

 private:
  std::string name(KeyNodeId id) const { return std::to_string(ids_[graph_.place(id)]); }

  std::string position(const Eigen::Vector3d& p) const {
    return planar_ ? joined({p.x(), p.y()}) : joined({p.x(), p.y(), p.z()});
  }

  /** Of each component the nodes that are fixed, or else the first one, if nothing else holds it.
   */
  std::string fixedNodes(bool with_priors) const {
    std::vector<bool> has_prior(graph_.nodes().size(), false);
    for (const Edge& edge : graph_.edges())
      if (with_priors && edge.type == EdgeType::kPrior) has_prior[graph_.place(edge.from)] = true;
    std::string text;
    for (const Component& component : graph_.components()) {
      bool held = false;
      for (const KeyNodeId id : component.nodes) {
        const bool is_fixed = graph_.node(id).fixed;
        if (is_fixed) text += "FIX " + name(id) + "\n";
        held = held || is_fixed || has_prior[graph_.place(id)];
      }
      if (!held) text += "FIX " + name(component.nodes.front()) + "\n";
    }
    return text;
  }

  std::string prior(const Edge& edge) const {
    return (planar_ ? "EDGE_PRIOR_SE2 " + name(edge.from)
                    : "EDGE_SE3_PRIOR " + name(edge.from) + " 0") +
           joined(format_.pose(edge.from_T_to)) + joined(upperTriangle(format_.information(edge))) +
           "\n";
  }

  std::string sighting(const Edge& edge) const {
    const int axes = planar_ ? 2 : 3;
    return (planar_ ? "EDGE_SE2_XY " : "EDGE_SE3_TRACKXYZ ") + name(edge.from) + " " +
           graph_.landmarks()[edge.landmark].name + (planar_ ? "" : " 0") +
           position(edge.from_T_to.translation()) +
           joined(upperTriangle(edge.information.topLeftCorner(axes, axes))) + "\n";
  }

  const PoseGraph& graph_;
  const std::vector<uint64_t>& ids_;
  const bool planar_;
  const TextFormat& format_;
};

}  // namespace

std::string toG2o(const PoseGraph& graph) {
  const std::vector<uint64_t> ids = denseIds(graph);
  return G2oWriter(graph, ids).text(false);
}

std::string toG2o(const G2oGraph& g2o) {
  const G2oWriter writer(g2o.graph, g2o.ids);
  return writer.parameters() + writer.text(true) + writer.landmarks();
}

}  // namespace lamp
