#pragma once

#include <string>
#include <vector>

#include "lamp/core/Options.h"

namespace lamp {

/** Limits of one run of a nonlinear least-squares solver. */
struct SolverOptions {
  int max_iterations = 100;
  double function_tolerance = 1e-9;

  void visit(OptionVisitor& v);
};

/** The solvers that Gnc can use: Lm, Gn, CeresLm (PlainOptimizers.h says what they are). */
const std::vector<std::string>& solverNames();

}  // namespace lamp
