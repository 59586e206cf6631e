#pragma once

#include <nlohmann/json.hpp>

#include "lamp/evaluation/RunEvaluation.h"

namespace lamp::evaluation {

/** All figures of the runs; keys carry units (docs/evaluation.md). */
nlohmann::ordered_json reportJson(const std::vector<RunEvaluation>& runs,
                                  const EvaluationInput& input);

}  // namespace lamp::evaluation
