#include "RunDescription.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>

#include "lamp/base_station/LoopCounts.h"
#include "lamp/core/Csv.h"

namespace lamp {

namespace {

std::string names(const RobotTable& robots, const std::vector<RobotId>& ids) {
  std::string text;
  for (const RobotId robot : ids) text += (text.empty() ? "" : ", ") + robots.name(robot);
  return text;
}

/** Placements to name before "and so many more". */
constexpr size_t kNamedPlacements = 4;

/** One decimal, and no minus before zero. */
std::string rounded(double value) {
  std::ostringstream text;
  text << std::fixed << std::setprecision(1) << std::round(value * 10) / 10 + 0.0;
  return text.str();
}

std::string describePlacements(const std::vector<Pose3>& placements) {
  std::string text;
  for (size_t k = 0; k < std::min(kNamedPlacements, placements.size()); ++k) {
    const Vector6d pose = yawPitchRollFromPose(placements[k]);
    text += (k == 0 ? "(" : ", (") + rounded(pose[0]) + " " + rounded(pose[1]) + " " +
            rounded(pose[2]) + ", " + rounded(pose[3] * 180.0 / M_PI) + ")";
  }
  if (placements.size() > kNamedPlacements)
    text += " and " + std::to_string(placements.size() - kNamedPlacements) + " more";
  return text;
}

/** Why two robots stay apart. */
std::string describeFrames(const FrameAgreement& frames, const RobotTable& robots) {
  const std::string a = robots.name(frames.a), b = robots.name(frames.b);
  if (frames.contradicting > 0) {
    const auto percent = std::to_string(std::lround(100 * frames.contradicting));
    return a + " and " + b + ": " + std::to_string(frames.agreeing) +
           " loop closures between them agree on a placement that " + percent +
           " % of what can be compared contradicts: one has seen it where the other saw through.";
  }
  if (frames.equally_good.empty())
    return a + " and " + b + ": of " + std::to_string(frames.loops) +
           " loop closures between them " + std::to_string(frames.agreeing) +
           " agree, each between different key nodes; " + std::to_string(frames.needed) +
           " are needed.";
  return a + " and " + b + " see places that look alike: these placements of " + b +
         "'s first key node, seen from " + a +
         "'s (x y z in metres, yaw in degrees), are equally good: " +
         describePlacements(frames.equally_good) +
         ". They stay apart; a start pose or a place that both have seen and that is like no other "
         "would tell.";
}

/** One line for each. */
std::string describeMaps(const RunFolder& folder, const RunResult& result,
                         const std::vector<Component>& components) {
  std::ostringstream text;
  for (size_t rank = 0; rank < components.size(); ++rank) {
    const Component& component = components[rank];
    const ComponentLoops inliers = countLoops(result.base_station.graph(), component);
    text << "map " << rank + 1 << " of " << components.size() << ": "
         << names(result.robots, component.robots) << " (" << component.nodes.size()
         << " key nodes, " << inliers.within_robots << " loops within robots, "
         << inliers.between_robots << " between): " << folder.mapStem(rank) << ".*\n";
  }
  return text.str();
}

/** What the joint adjustment has done; nothing if it took no part. */
std::string describeRefinement(const JointAdjustmentReport& report) {
  if (report.surfels == 0) return "";
  if (report.pairs == 0)
    return "refinement: no two key nodes share enough surface to be adjusted together\n";
  const std::string before = formatFixed(1000 * report.before.rms_m, 1),
                    after = formatFixed(1000 * report.after.rms_m, 1);
  if (!report.kept)
    return "refinement: undone, since surfaces that were held back did not come nearer to one "
           "another (" +
           before + " mm)\n";
  return "refinement: " + std::to_string(report.surfels) + " surfaces tie " +
         std::to_string(report.pairs) + " pairs of key nodes; others that were held back lie " +
         after + " mm apart instead of " + before + "\n";
}

}  // namespace

std::string describeRun(const RunFolder& folder, const RunResult& result) {
  const BaseStation& base = result.base_station;
  const LoopCounts loops = countLoops(base);
  const auto components = base.graph().components();
  std::ostringstream text;
  text << base.graph().nodes().size() << " key nodes, " << loops.attempts
       << " loop closures tried, " << loops.verified << " verified, " << loops.inliers << " kept\n"
       << describeMaps(folder, result, components);
  if (const MeasurementCounts counts = countMeasurements(base.graph()); counts.edges > 0)
    text << "other sensors: " << counts.edges << " measurements of gravity, "
         << base.graph().landmarks().size() << " landmarks and distances, " << counts.inliers
         << " kept\n";
  text << describeRefinement(base.refinement());
  if (components.size() > 1)
    text << "No trusted loop closure joins these " << components.size()
         << " components: they stay separate maps.\n";
  if (const double scale = base.lastReport().odometry_scale; scale > 1.0)
    text << "The loop closures show that odometry is worse than its covariances state: they were "
            "scaled up "
         << scale << " times larger.\n";
  for (const FrameAgreement& frames : base.lastReport().frames)
    if (!frames.joined) text << describeFrames(frames, result.robots) << "\n";
  if (!result.world_p_origin.isZero(0)) {
    text
        << "The maps are in a frame of their own near the robots: their files and summary.json say "
           "what to add for world coordinates:";
    for (const double coordinate : result.world_p_origin) text << " " << formatFixed(coordinate, 0);
    text << " m\n";
  }
  if (result.interrupted) text << "The run was interrupted: this is the map up to that point.\n";
  return text.str();
}

}  // namespace lamp
