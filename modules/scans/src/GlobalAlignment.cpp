#include "lamp/scans/GlobalAlignment.h"

#include <algorithm>
#include <cmath>

#include "VectorKernels.h"
#include "lamp/core/ChiSquare.h"
#include "lamp/scans/ConsistencyGraph.h"
#include "lamp/scans/RobustPose.h"

namespace lamp {

namespace {

/** Coordinates of matches, one array a coordinate, for loops over all of them. */
struct MatchColumns {
  explicit MatchColumns(const std::vector<Match>& matches, const Features& source,
                        const Features& target)
      : count(matches.size()), values(kColumns * count) {
    for (size_t i = 0; i < count; ++i)
      for (size_t axis = 0; axis < 3; ++axis) {
        const auto row = static_cast<Eigen::Index>(axis);
        values[axis * count + i] = source.points[matches[i].source][row];
        values[(3 + axis) * count + i] = target.points[matches[i].target][row];
        values[(6 + axis) * count + i] = source.normals[matches[i].source][row];
        values[(9 + axis) * count + i] = target.normals[matches[i].target][row];
      }
  }

  static constexpr size_t kColumns = 12;
  size_t count;
  std::vector<float> values;
};

/** Which pairs of matches one rigid motion can explain: the distance of the points, the angle
 * between the normals, and how far each point lies above the other one's tangent plane stay. */
ConsistencyGraph consistencyGraph(const std::vector<Match>& matches, const Features& source,
                                  const Features& target, const ConsistencyOptions& options) {
  const MatchColumns columns(matches, source, target);
  ConsistencyGraph graph(matches.size());
  std::vector<int32_t> consistent(matches.size());
  for (size_t i = 0; i + 1 < matches.size(); ++i) {
    consistentWith(
        columns.values.data(), columns.count, i, static_cast<float>(2 * options.noise_bound_m),
        static_cast<float>(options.max_normal_angle_deg * M_PI / 180.0), consistent.data());
    for (size_t j = i + 1; j < matches.size(); ++j)
      if (consistent[j] && matches[i].source != matches[j].source &&
          matches[i].target != matches[j].target)
        graph.connect(i, j);
  }
  return graph;
}

/** Where the partner of each keypoint may lie, given the guess. */
Whereabouts whereabouts(const Features& source, const UncertainPose& guess,
                        const ConsistencyOptions& options) {
  const double quantile = chiSquareQuantile(options.guess_probability, 3);
  Whereabouts result;
  for (const Eigen::Vector3f& point : source.points) {
    // T Exp(d) p moves by R (v - p x w), d = (v, w).
    Eigen::Matrix<double, 3, 6> J;
    J << Eigen::Matrix3d::Identity(), -skew(point.cast<double>());
    const double variance = (J * guess.covariance * J.transpose()).trace();
    result.centers.push_back((guess.target_T_source * point.cast<double>()).cast<float>());
    result.radii.push_back(
        static_cast<float>(std::sqrt(quantile * variance) + 2 * options.noise_bound_m));
  }
  return result;
}

std::vector<PointPair> pointPairs(const std::vector<Match>& matches, const Features& source,
                                  const Features& target) {
  std::vector<PointPair> pairs;
  pairs.reserve(matches.size());
  for (const Match& match : matches)
    pairs.push_back(
        {source.points[match.source].cast<double>(), target.points[match.target].cast<double>()});
  return pairs;
}

/** Counts the matches that the pose brings within a distance. \param[in,out] left these are not
 * left for another pose. */
GlobalPose withInliers(const Pose3& pose, const std::vector<PointPair>& pairs, double distance_m,
                       std::vector<bool>& left) {
  GlobalPose found{pose, 0, 0};
  for (size_t m = 0; m < pairs.size(); ++m) {
    if ((pairs[m].target - pose * pairs[m].source).norm() > distance_m) continue;
    left[m] = false;
    ++found.inliers;
  }
  found.inlier_ratio = static_cast<double>(found.inliers) / static_cast<double>(pairs.size());
  return found;
}

}  // namespace

void ConsistencyOptions::visit(OptionVisitor& v) {
  v("match_rank", match_rank, "",
    "two keypoints match if each is among the other's this many most similar ones", {1, 10});
  v("noise_bound_m", noise_bound_m, "m",
    "maximum error of a correct match; close to the voxel size", kPositive);
  v("max_normal_angle_deg", max_normal_angle_deg, "deg",
    "maximum error of the angle between two normals of correct matches", kPositive);
  v("min_inliers", min_inliers, "matches", "minimum number of agreeing matches for a hypothesis",
    {3});
  v("max_hypotheses", max_hypotheses, "",
    "maximum number of hypotheses passed on to the refinement", {1});
  v("guess_probability", guess_probability, "",
    "probability that a correct match is consistent with the guess, where the guess's covariance "
    "is known",
    {0.5, 1.0 - 1e-12});
  v("upright", upright, "search rotations about z only, for scans that are both level");
}

std::vector<GlobalPose> alignByConsistency(const Features& source, const Features& target,
                                           const std::optional<UncertainPose>& guess,
                                           const ConsistencyOptions& given) {
  ConsistencyOptions options = given;
  options.noise_bound_m *= std::max(source.coarseness, target.coarseness);
  std::optional<Whereabouts> within;
  if (guess) within = whereabouts(source, *guess, options);
  const std::vector<Match> matches = mutualMatches(source, target, options.match_rank, within);
  const std::vector<PointPair> pairs = pointPairs(matches, source, target);
  const ConsistencyGraph graph = consistencyGraph(matches, source, target, options);
  std::vector<bool> left(matches.size(), true);
  std::vector<GlobalPose> poses;
  while (static_cast<int>(poses.size()) < options.max_hypotheses) {
    const std::vector<uint32_t> clique = maximumClique(graph, left);
    if (clique.size() < static_cast<size_t>(options.min_inliers)) break;
    std::vector<PointPair> consistent;
    for (const uint32_t m : clique) {
      left[m] = false;
      consistent.push_back(pairs[m]);
    }
    const auto pose = robustPose(consistent, options.noise_bound_m, options.upright);
    if (!pose) continue;
    const GlobalPose found = withInliers(*pose, pairs, 2 * options.noise_bound_m, left);
    if (found.inliers >= static_cast<size_t>(options.min_inliers)) poses.push_back(found);
  }
  std::stable_sort(poses.begin(), poses.end(),
                   [](const GlobalPose& a, const GlobalPose& b) { return a.inliers > b.inliers; });
  return poses;
}

}  // namespace lamp
