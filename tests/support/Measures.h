#pragma once

#include <string>
#include <vector>

#include "lamp/core/KeyframePacket.h"

namespace lamp::test {

/** Root mean square of the position errors, with the first poses laid onto each other.
 *  \throws std::runtime_error if a pose of `estimate` has no true one at its stamp. */
double ateFromFirst(const std::vector<StampedPose>& estimate,
                    const std::vector<StampedPose>& truth);

/** A true motion between two stamps. */
struct Relation {
  double from = 0, to = 0;  ///< stamps
  Pose3 from_T_to = Pose3::Identity();
};

/** Reads `from to x y z roll pitch yaw` rows (Kuemmerle et al. 2009). */
std::vector<Relation> readRelations(const std::string& path);

/** Mean relation error. */
struct RelationError {
  double metres = 0, radians = 0;
  size_t relations = 0;
};

/** Kuemmerle et al., "On measuring the accuracy of SLAM algorithms", 2009: the mean of the errors
 * `true⁻¹ · estimated` over the relations that last from `min_seconds` to below `max_seconds`.
 *  \throws std::runtime_error if the trajectory has no pose at a relation's stamp. */
RelationError relationError(const std::vector<StampedPose>& trajectory,
                            const std::vector<Relation>& relations, double min_seconds,
                            double max_seconds);

/** Number of cubes with a point in them. */
size_t occupiedCells(const std::vector<Eigen::Vector3f>& points, double edge_m);

}  // namespace lamp::test
