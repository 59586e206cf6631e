#include "OdometryComparison.h"

#include <cmath>
#include <utility>

#include "lamp/core/Csv.h"

namespace lamp {

namespace {

/** Less than this may be missing at the ends of a recording. */
constexpr double kMissingS = 1.0;
/** Recorded odometry that moves less between two scans stands. */
constexpr double kStandsM = 1e-4, kStandsRad = 1e-4;
/** A lidar that moves faster does not, */
constexpr double kMovesMPerS = 0.2, kMovesRadPerS = 0.15;
/** if this lasts so long: clocks may differ. */
constexpr double kLastsS = 2.0;

bool moves(const Pose3& motion, double most_m, double most_rad) {
  return motion.translation().norm() > most_m || rotationAngle(motion) > most_rad;
}

}  // namespace

void OdometryComparison::Occurrence::add(double begin, double duration) {
  if (!first) first = begin;
  seconds += duration;
}

void OdometryComparison::observe(const StampedPose& scan, OdometrySource& recorded) {
  const auto last = std::exchange(last_, scan);
  if (!last) return;
  const double seconds = scan.stamp - last->stamp;
  const bool known =
      recorded.covers(scan.stamp) && recorded.knows(last->stamp) && recorded.knows(scan.stamp);
  known_ = known_ || known;
  if (!known) {
    unknown_.add(last->stamp, seconds);
    stands_now_ = {};
    return;
  }
  clock_.observe(*last, scan, recorded);
  const Pose3 said = recorded.poseAt(last->stamp).inverse() * recorded.poseAt(scan.stamp);
  const Pose3 seen = last->pose.inverse() * scan.pose;
  watchStanding(last->stamp, scan.stamp,
                !moves(said, kStandsM, kStandsRad) &&
                    moves(seen, kMovesMPerS * seconds, kMovesRadPerS * seconds));
}

/** \param stands recorded odometry alone. */
void OdometryComparison::watchStanding(double begin, double end, bool stands) {
  if (!stands) {
    stands_now_ = {};
    return;
  }
  stands_now_.add(begin, end - begin);
  if (end - *stands_now_.first < kLastsS) return;
  standing_.add(*stands_now_.first, stands_now_.seconds);
  stands_now_.seconds = 0;
}

std::vector<std::string> OdometryComparison::warnings() const {
  std::vector<std::string> result;
  if (known_ && unknown_.seconds > kMissingS)
    result.push_back("recorded odometry says nothing of " + formatFixed(unknown_.seconds, 1) +
                     " s, first from " + formatFixed(*unknown_.first, 3) +
                     " on: it begins later, ends earlier, or has gaps in which the robot moved; "
                     "the motion is that of the lidar alone");
  if (standing_.seconds > 0)
    result.push_back("recorded odometry says that the robot stands in " +
                     formatFixed(standing_.seconds, 1) +
                     " s in which the lidar moves, first from " + formatFixed(*standing_.first, 3) +
                     " on; look for an encoder or a driver that failed");
  if (const auto offset = clock_.wrong())
    result.push_back("the clocks of recorded odometry and lidar differ: turns have stamps " +
                     formatFixed(std::abs(*offset), 2) + " s " +
                     (*offset > 0 ? "later" : "earlier") +
                     " in the odometry; synchronise them, or correct the recording's stamps");
  return result;
}

}  // namespace lamp
