#pragma once

#include <vector>

#include "lamp/core/LoopClosure.h"
#include "lamp/core/PoseGraph.h"
#include "lamp/core/UncertaintyQuery.h"
#include "lamp/registration/InitialAligner.h"

namespace lamp {

/** What the poses of the graph say of a candidate: the newer key node (source) seen from the older
 * one (target), without a covariance. Of robots that share no frame they say nothing: there it is
 * what the generator has recognised. */
Guess graphGuess(const PoseGraph& graph, const LoopClosureCandidate& candidate);

/** The same for many, with the graph's covariance where the two robots share a frame. */
std::vector<Guess> graphGuesses(const PoseGraph& graph,
                                const std::vector<LoopClosureCandidate>& candidates,
                                const UncertaintyQuery& uncertainty);

}  // namespace lamp
