#pragma once

#include <string>
#include <vector>

#include "lamp/core/Trajectory.h"
#include "lamp/evaluation/Statistics.h"

namespace lamp::evaluation {

/** A true motion between two scans, by stamp (Kümmerle et al., "On measuring the accuracy of SLAM
 * algorithms", Autonomous Robots 2009). */
struct Relation {
  double from = 0, to = 0;  ///< seconds, on the clock of the relations
  Pose3 from_T_to = Pose3::Identity();
};

/** Reads `stamp1 stamp2 x y z roll pitch yaw` rows; `#` starts a comment.
 *  \throws std::runtime_error with file and line if a row is malformed, or the file has none. */
std::vector<Relation> readRelations(const std::string& path);

/** The trajectory with the stamps of the relations' clock.
 *  \param scan_stamps file of three columns: scan number, stamp of the relations' clock, stamp of
 *  the recording; in time order. Scans of which the trajectory has no pose are skipped.
 *  \throws std::runtime_error if the file is malformed, or does not name a stamp of the trajectory.
 */
std::vector<StampedPose> withRelationStamps(std::vector<StampedPose> trajectory,
                                            const std::string& scan_stamps);

/** Errors `e = true⁻¹ · estimated` of the relations whose two scans both have a pose. */
struct RelationError {
  Statistics translation_m;  ///< ‖trans(e)‖
  Statistics rotation_deg;   ///< |angle(e)|
};
struct RelationErrors {
  RelationError all, below_5_s, from_5_s;
  size_t without_pose = 0;  ///< relations that could not be compared
};
/** \throws std::runtime_error if no relation could be compared. */
RelationErrors relationErrors(const std::vector<StampedPose>& trajectory,
                              const std::vector<Relation>& relations);

}  // namespace lamp::evaluation
