#pragma once

#include <string>
#include <vector>

#include "lamp/evaluation/RunFiles.h"
#include "lamp/evaluation/TrueSurface.h"
#include "lamp/evaluation/Truth.h"

namespace lamp::evaluation {

/** The points of keyed scans, told apart by the truth, each where the run puts it: in the frame of
 * the true surface, metres. */
struct ScannedPoints {
  /** Of people and vehicles, farther than 0.4 m from the true surface: nearer ones may share their
   * place with it. */
  std::vector<Eigen::Vector3f> moving;
  std::vector<Eigen::Vector3f> fixed;  ///< of the true surface, within 0.3 m
  std::vector<Eigen::Vector3f> stray;  ///< of neither: dust, faults
  std::vector<std::string> notes;      ///< what was not read, and why
};

/** Reads the keyed scans of a component's robots, and of the truth `<robot>.movers.ply`: `scan x y
 * z`, the row of `<robot>.tum` and a return from what moves in the base's frame there; a point
 * within 5 cm of one is moving. Scans without a true pose are left out.
 * \throws std::runtime_error naming a file that is malformed. */
ScannedPoints scannedPoints(const RunFiles& run, size_t component, const TruthFolder& truth,
                            const Pose3& surface_T_world, const TrueSurface& surface);

/** How many of the points are in a map. */
struct PointsKept {
  size_t points = 0, kept = 0;
};

/** What a point cloud keeps of the scans: a point is kept if the cloud has one within 0.1 m. */
struct MapRemoval {
  PointsKept moving, fixed, stray;
};

/** \param cloud in the frame of the true surface. */
MapRemoval evaluateRemoval(const ScannedPoints& scanned, const std::vector<Eigen::Vector3f>& cloud);

}  // namespace lamp::evaluation
