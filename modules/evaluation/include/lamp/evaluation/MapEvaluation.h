#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lamp/core/Geometry.h"
#include "lamp/evaluation/ScannedPoints.h"
#include "lamp/evaluation/Statistics.h"
#include "lamp/evaluation/TrueSurface.h"

namespace lamp::evaluation {

/** A point cloud against the true surface. */
struct MapEvaluation {
  std::string name;                                          ///< `map`, `map_2`, ...
  Eigen::Vector3d world_p_origin = Eigen::Vector3d::Zero();  ///< as of the true surface
  std::vector<Eigen::Vector3f> points;  ///< of the map, in the frame of the true surface
  std::vector<float> errors_m;          ///< of each point: distance to the true surface
  Statistics accuracy_m;                ///< of the errors
  double completeness = 0;              ///< share of the seen samples with a point within 0.2 m
  std::optional<MapRemoval> removal;    ///< of the largest component
};

/** \param cloud path of a PLY file with `x y z`. \param surface_T_world the alignment.
 *  \throws std::runtime_error if the file is malformed or holds no point. */
MapEvaluation evaluateMap(const std::string& cloud, const Pose3& surface_T_world,
                          const TrueSurface& surface);

/** Writes the points as PLY with `error` in metres, coloured by it from zero to `full_scale_m`. */
void writeErrorPly(const std::string& path, const MapEvaluation& map, double full_scale_m);

/** A round number (1, 2 or 5 times a power of ten) at which the colours of an error map end: above
 * 95 % of the errors, 0.1 m at least. */
double errorScale(const MapEvaluation& map);

}  // namespace lamp::evaluation
