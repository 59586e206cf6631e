#include "lamp/registration/Refiner.h"

#include <algorithm>

#include "lamp/scans/Slide.h"

IMPLEMENTS_VIRTUAL_MRPT_OBJECT(Refiner, Stage, lamp)
IMPLEMENTS_MRPT_OBJECT(Gicp, lamp::Refiner, lamp)
IMPLEMENTS_MRPT_OBJECT(PointToPlane, lamp::Refiner, lamp)

namespace lamp {

namespace {

/** A pose that ICP has found, and what is known of it. */
struct Refined {
  IcpResult icp;
  RegistrationInformation known;
};

Refined refinedFrom(const Pose3& start, IcpMetric metric, const IcpOptions& icp_options,
                    const RegistrationInformationOptions& information, const PreparedScan& source,
                    const PreparedScan& target) {
  Refined refined;
  refined.icp = icp(source, target, start, metric, icp_options);
  if (!refined.icp.converged) return refined;
  const MatchedSurface surface = matchedSurface(source, target, refined.icp.target_T_source,
                                                icp_options.correspondence_m, icp_options.kernel_m);
  refined.known = registrationInformation(surface, refined.icp.target_T_source, information,
                                          source.planar() && target.planar());
  return refined;
}

/** Whether all translations but the one along the first axis are observed. */
bool slidesAlongOneAxis(const Refined& refined, const RegistrationInformationOptions& options) {
  const Eigen::Vector3d& observed = refined.known.observability.translation;
  return refined.icp.converged && observed[0] < options.min_translation_observability &&
         observed[1] >= options.min_translation_observability;
}

/** Where the pose slides along an axis, and a surface across the axis shows that it has slid too
 * far, goes on from where that surface lies in both scans. */
Refined onSurfacesAcross(Refined refined, IcpMetric metric, const RefinerOptions& options,
                         const PreparedScan& source, const PreparedScan& target) {
  if (!slidesAlongOneAxis(refined, options.information)) return refined;
  const Eigen::Vector3d axis = refined.known.observability.translations.col(0);
  const auto slide = slideOntoSurfacesAcross(source, target, refined.icp.target_T_source, axis);
  if (!slide) return refined;
  const Pose3 start = Eigen::Translation3d(*slide * axis) * refined.icp.target_T_source;
  const Refined slid = refinedFrom(start, metric, options.icp, options.information, source, target);
  const bool is_held = slid.icp.converged && slid.known.observability.translation[0] >=
                                                 options.information.min_translation_observability;
  return is_held ? slid : refined;
}

RegistrationResult refineWith(IcpMetric metric, const RefinerOptions& options,
                              const PreparedScan& source, const PreparedScan& target,
                              const Hypothesis& hypothesis) {
  IcpOptions icp_options = options.icp;
  if (hypothesis.accuracy_m)
    icp_options.start_correspondence_m =
        std::min(icp_options.start_correspondence_m, *hypothesis.accuracy_m);
  const Refined refined =
      onSurfacesAcross(refinedFrom(hypothesis.target_T_source, metric, icp_options,
                                   options.information, source, target),
                       metric, options, source, target);
  RegistrationResult result;
  result.start = hypothesis.target_T_source;
  result.target_T_source = refined.icp.target_T_source;
  result.converged = refined.icp.converged;
  result.iterations = refined.icp.iterations;
  if (!result.converged) return result;
  result.information = refined.known.information;
  result.unobserved = refined.known.unobserved;
  result.scores = {{"translation_observability", refined.known.observability.translation[0],
                    options.information.min_translation_observability},
                   {"rotation_observability", refined.known.observability.rotation[0],
                    options.information.min_rotation_observability}};
  return result;
}

}  // namespace

void RefinerOptions::visit(OptionVisitor& v) {
  icp.visit(v);
  information.visit(v);
}

RegistrationResult Gicp::refine(const PreparedScan& source, const PreparedScan& target,
                                const Hypothesis& hypothesis) const {
  return refineWith(IcpMetric::kPlaneToPlane, options, source, target, hypothesis);
}

RegistrationResult PointToPlane::refine(const PreparedScan& source, const PreparedScan& target,
                                        const Hypothesis& hypothesis) const {
  return refineWith(IcpMetric::kPointToPlane, options, source, target, hypothesis);
}

}  // namespace lamp
