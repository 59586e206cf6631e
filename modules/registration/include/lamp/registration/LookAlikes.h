#pragma once

#include <vector>

#include "lamp/registration/Refiner.h"

namespace lamp {

/** Where look-alikes of an accepted registration are sought. */
struct LookAlikeOptions {
  int look_alike_starts = 16;
  double look_alike_sigmas = 2.0;

  void visit(OptionVisitor& v);
};

/** Poses that a registration might as well have ended at if the place looks alike further on, such
 * as in a row of pillars: horizontal shifts as far as the uncertainty of the guess allows, first
 * those that the least surface stands in the way of. None if the guess is sure to a step of 1.5 m,
 * or has no covariance. Other storeys are left to GuessDeviation. */
std::vector<Pose3> lookAlikeStarts(const RegistrationResult& result, const Guess& guess,
                                   const PreparedScan& source, const PreparedScan& target,
                                   const LookAlikeOptions& options);

/** How well a relative pose fits two scans. */
struct Fit {
  /** Patches of surface, those of both scans, that the other scan has seen, too, or through which
   * its rays have passed. */
  double agreeing = 0, contradicting = 0;
  double residual_m = 0;  ///< r.m.s. point-to-plane distance
};
Fit fitOf(const PreparedScan& source, const PreparedScan& target, const Pose3& target_T_source);

/** Whether the scans do not tell that another pose is wrong, as they fit at one that is accepted.
 * That less overlaps is no argument: it may be that what only one has seen lies there. */
bool isAsGood(const Fit& other, const Fit& accepted);

}  // namespace lamp
