#include "lamp/registration/PlanarSearch.h"

#include <algorithm>
#include <cmath>

#include "lamp/scans/PlanarAlignment.h"

IMPLEMENTS_MRPT_OBJECT(PlanarSearch, lamp::InitialAligner, lamp)

namespace lamp {

namespace {

/** What the guess allows, three standard deviations each way; all headings without covariance. */
PlanarWindow windowAround(const Guess& guess, double radius_m) {
  PlanarWindow window;
  window.half_width_m = radius_m;
  if (!guess.covariance) return window;
  constexpr double kSigmas = 3;
  const Pose3& pose = guess.target_T_source;
  const double variance_m2 = std::max((*guess.covariance)(0, 0), (*guess.covariance)(1, 1));
  window.centre = pose.translation().head<2>();
  window.half_width_m = std::min(radius_m, kSigmas * std::sqrt(variance_m2));
  window.yaw = std::atan2(pose.linear()(1, 0), pose.linear()(0, 0));
  window.half_yaw = std::min(M_PI, kSigmas * std::sqrt((*guess.covariance)(5, 5)));
  return window;
}

}  // namespace

void PlanarSearchOptions::visit(OptionVisitor& v) {
  v("search_radius_m", search_radius_m, "m",
    "maximum distance between two key nodes that is searched", kPositive);
  v("max_hypotheses", max_hypotheses, "",
    "maximum number of different poses that are followed; more recognise more places that look "
    "alike in two ways",
    {1});
}

AlignmentResult PlanarSearch::align(const PreparedScan& source, const PreparedScan& target,
                                    const Guess& guess) const {
  if (!source.planar() || !target.planar()) return {{}, "not both scans are planar"};
  std::vector<Eigen::Vector3f> own;
  for (const uint32_t i : source.own()) own.push_back(source.points()[i]);
  AlignmentResult result;
  for (const PlanarPlacement& placement :
       alignInPlane(own, target.occupancy(), windowAround(guess, options.search_radius_m),
                    static_cast<size_t>(options.max_hypotheses))) {
    Hypothesis hypothesis;
    hypothesis.target_T_source = placement.target_T_source;
    hypothesis.accuracy_m = 2 * OccupancyPyramid::kCell_m;
    result.hypotheses.push_back(hypothesis);
  }
  if (result.hypotheses.empty()) result.refusal = "no pose brings enough of the scans together";
  return result;
}

}  // namespace lamp
