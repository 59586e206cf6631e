#pragma once

#include <utility>
#include <vector>

#include "lamp/loop_candidates/CandidateGenerator.h"

namespace lamp {

/** What both radius generators share: the key nodes nearest to the current one, within a radius
 * that the derived class gives. Of the other robots only the nearest few count, since else the work
 * would grow with the square of the number of robots in one place. Robots whose poses cannot be
 * compared (PoseGraph::shareFrame) are left out. */
class RadiusGenerator : public CandidateGenerator {
  DEFINE_VIRTUAL_MRPT_OBJECT(RadiusGenerator)

 public:
  std::vector<LoopClosureCandidate> propose(const PoseGraph& graph, KeyNodeId current) override;

 protected:
  /** A key node and how far it is from the current one. */
  using Near = std::pair<double, KeyNodeId>;
  struct Limits {
    int min_index_gap = 10;
    int max_per_robot = 3;
    int max_other_robots = 4;
  };
  virtual Limits limits() const = 0;
  /** Search radius between two key nodes of one robot, metres. */
  virtual double radiusWithin(uint32_t current_index, uint32_t candidate_index) const = 0;
  /** Search radius from the current key node to those of other robots, metres. */
  virtual double radiusBetween(uint32_t current_index) const = 0;

 private:
  std::vector<Near> nearestOf(const PoseGraph& graph, RobotId robot, KeyNodeId current) const;
};

struct FixedRadiusOptions {
  double radius_m = 10.0;
  double between_robots_radius_m = 20.0;
  int min_index_gap = 10;
  int max_per_robot = 3;
  int max_other_robots = 4;

  void visit(OptionVisitor& v);
};

/** LAMP 1.0: one radius for all. */
class FixedRadius : public RadiusGenerator {
  DEFINE_MRPT_OBJECT(FixedRadius, lamp)

 public:
  FixedRadiusOptions options;
  void visit(OptionVisitor& v) override { options.visit(v); }

 protected:
  Limits limits() const override {
    return {options.min_index_gap, options.max_per_robot, options.max_other_robots};
  }
  double radiusWithin(uint32_t, uint32_t) const override { return options.radius_m; }
  double radiusBetween(uint32_t) const override { return options.between_robots_radius_m; }
};

struct AdaptiveRadiusOptions {
  double alpha_m = 0.2;
  double min_radius_m = 3.0;
  double max_radius_m = 30.0;
  double between_robots_min_radius_m = 5.0;
  double between_robots_max_radius_m = 80.0;
  int min_index_gap = 10;
  int max_per_robot = 3;
  int max_other_robots = 4;

  void visit(OptionVisitor& v);
};

/** LAMP 2.0 (paper II-C): the radius grows with the way travelled, as the drift does. Within a
 * robot `d_max = α |n_curr - n_cand|`, between robots `d_max = α n_curr`, each within limits. */
class AdaptiveRadius : public RadiusGenerator {
  DEFINE_MRPT_OBJECT(AdaptiveRadius, lamp)

 public:
  AdaptiveRadiusOptions options;
  void visit(OptionVisitor& v) override { options.visit(v); }

 protected:
  Limits limits() const override {
    return {options.min_index_gap, options.max_per_robot, options.max_other_robots};
  }
  double radiusWithin(uint32_t current_index, uint32_t candidate_index) const override;
  double radiusBetween(uint32_t current_index) const override;
};

}  // namespace lamp
