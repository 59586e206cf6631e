#include "lamp/registration/FreeSpaceConsistency.h"

#include <algorithm>

#include "lamp/scans/Agreement.h"

IMPLEMENTS_MRPT_OBJECT(FreeSpaceConsistency, lamp::Verifier, lamp)

namespace lamp {

void FreeSpaceConsistencyOptions::visit(OptionVisitor& v) {
  v("max_share", max_share, "",
    "maximum fraction of points lying where the other scan's rays passed through", kShare);
  v("margin_m", margin_m, "m", "distance in front of a surface that still counts as on it",
    kPositive);
}

Verification FreeSpaceConsistency::verify(const RegistrationResult& result,
                                          const PreparedScan& source, const PreparedScan& target,
                                          const Guess&) const {
  if (!isFinite(result.target_T_source)) return {"not a pose", {}};
  const double share = std::max(
      shareInFreeSpace(source, target, result.target_T_source, options.margin_m),
      shareInFreeSpace(target, source, result.target_T_source.inverse(), options.margin_m));
  Verification verification;
  verification.scores = {{"free_space", share, options.max_share}};
  if (share > options.max_share) verification.refusal = "points in free space";
  return verification;
}

}  // namespace lamp
