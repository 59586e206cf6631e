#pragma once

#include <limits>
#include <utility>
#include <vector>

#include "lamp/core/PoseGraph.h"
#include "lamp/core/Stage.h"

namespace lamp {

/** How close two robots that no start poses relate are to a common map. */
struct FrameAgreement {
  RobotId a, b;
  size_t loops = 0;     ///< between the two
  size_t agreeing = 0;  ///< of those, how many agree, each with key nodes of its own
  size_t needed = 0;
  bool joined = false;
  /** Placements of b's first key node in the frame of a's, the best first, if several explain about
   * equally well what both robots have seen. The robots then stay apart. */
  std::vector<Pose3> equally_good = {};
  /** If what both have seen contradicts the placement that the loops agree on, the share of the
   * comparable surfaces that does. The robots then stay apart. */
  double contradicting = 0;
};

/** What is known about a graph's edges before the optimisation. */
struct Admission {
  /** \param admitted_edges one flag per edge: whether it may take part. */
  explicit Admission(std::vector<bool> admitted_edges = {})
      : admitted(std::move(admitted_edges)),
        waiting(admitted.size(), false),
        likely(admitted.size(), false) {}

  std::vector<bool> admitted;
  /** Loop closures that are not admitted unless the solution without them bears them out
   * (borneOut()). */
  std::vector<bool> waiting;
  std::vector<bool> likely;     ///< waiting loops that need only agree with that solution
  double odometry_scale = 1.0;  ///< by which odometry's covariances exceed those stated
  /** How many false loops there are, as far as odometry can tell. */
  double false_loops = std::numeric_limits<double>::infinity();
  /** A loop is admitted if a false one would agree as well with at most this probability. */
  double max_chance = 1.0;
  std::vector<FrameAgreement> frames;
};

/** Decides before the optimisation which loop closures may take part in it (paper II-D). */
class OutlierRejection : public Stage {
  DEFINE_VIRTUAL_MRPT_OBJECT(OutlierRejection)

 public:
  /** \param before what earlier stages found; loops that are out already stay out.
   * \return the same, with what this stage finds. */
  virtual Admission reject(const PoseGraph& graph, Admission before) = 0;
};

}  // namespace lamp
