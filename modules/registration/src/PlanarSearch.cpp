#include "lamp/registration/PlanarSearch.h"

#include "lamp/scans/PlanarAlignment.h"

IMPLEMENTS_MRPT_OBJECT(PlanarSearch, lamp::InitialAligner, lamp)

namespace lamp {

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
  if (guess.covariance) return {{}, "the graph has a guess"};
  std::vector<Eigen::Vector3f> own;
  for (const uint32_t i : source.own()) own.push_back(source.points()[i]);
  AlignmentResult result;
  for (const PlanarPlacement& placement :
       alignInPlane(own, target.occupancy(), options.search_radius_m,
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
