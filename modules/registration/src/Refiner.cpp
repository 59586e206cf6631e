#include "lamp/registration/Refiner.h"

#include <algorithm>

IMPLEMENTS_VIRTUAL_MRPT_OBJECT(Refiner, Stage, lamp)
IMPLEMENTS_MRPT_OBJECT(Gicp, lamp::Refiner, lamp)
IMPLEMENTS_MRPT_OBJECT(PointToPlane, lamp::Refiner, lamp)

namespace lamp {

namespace {

RegistrationResult refineWith(IcpMetric metric, const RefinerOptions& options,
                              const PreparedScan& source, const PreparedScan& target,
                              const Hypothesis& hypothesis) {
  IcpOptions icp_options = options.icp;
  if (hypothesis.accuracy_m)
    icp_options.start_correspondence_m =
        std::min(icp_options.start_correspondence_m, *hypothesis.accuracy_m);
  const IcpResult icp_result = icp(source, target, hypothesis.target_T_source, metric, icp_options);
  RegistrationResult result;
  result.start = hypothesis.target_T_source;
  result.target_T_source = icp_result.target_T_source;
  result.converged = icp_result.converged;
  result.iterations = icp_result.iterations;
  const RegistrationInformation known =
      registrationInformation(icp_result, options.information, source.planar() && target.planar());
  result.information = known.information;
  result.unobserved = known.unobserved;
  result.scores = {{"translation_observability", known.observability.translation[0],
                    options.information.min_translation_observability},
                   {"rotation_observability", known.observability.rotation[0],
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
