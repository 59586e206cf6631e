#include "lamp/evaluation/TimeJoin.h"

#include <algorithm>
#include <stdexcept>

#include "lamp/core/Csv.h"

namespace lamp::evaluation {

namespace {

std::string span(double begin, double end) {
  return formatFixed(begin, 3) + " to " + formatFixed(end, 3);
}

}  // namespace

JoinedTrajectory joinInTime(const std::vector<StampedPose>& estimate, const TrueTrajectory& truth,
                            const std::string& robot) {
  JoinedTrajectory joined;
  joined.estimated = estimate.size();
  for (size_t row = 0; row < estimate.size(); ++row)
    if (const auto pose = truth.at(estimate[row].stamp))
      joined.poses.push_back({estimate[row].stamp, estimate[row].pose, *pose, row});
  if (joined.poses.empty())
    throw std::runtime_error("robot '" + robot + "': no scan has a true pose; the run is of " +
                             span(estimate.front().stamp, estimate.back().stamp) +
                             " s, its truth of " + span(truth.begin(), truth.end()) + " s");
  joined.true_poses = truth.poses().size();
  joined.true_poses_met = static_cast<size_t>(
      std::count_if(truth.poses().begin(), truth.poses().end(), [&](const StampedPose& pose) {
        return pose.stamp >= estimate.front().stamp - TrueTrajectory::kSameStamp &&
               pose.stamp <= estimate.back().stamp + TrueTrajectory::kSameStamp;
      }));
  return joined;
}

}  // namespace lamp::evaluation
