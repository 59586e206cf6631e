#include "lamp/pose_graph/RobotFrames.h"

#include <algorithm>

#include "lamp/core/DisjointSets.h"
#include "rejection/FrameAverages.h"

IMPLEMENTS_MRPT_OBJECT(RobotFrames, OutlierRejection, lamp)

namespace lamp {

void RobotFramesOptions::visit(OptionVisitor& v) {
  v("min_agreeing", min_agreeing, "",
    "number of agreeing loop closures needed to join robots without start poses", {1});
}

namespace {

/** If all loops that agree were to wait, the solution would not join the two robots, and so could
 * bear out none. */
void admitWaiting(const FrameAverage& average, Admission& admission) {
  const std::vector<EdgeIndex>& loops = average.agreeing_loops;
  if (std::any_of(loops.begin(), loops.end(), [&](EdgeIndex e) { return admission.admitted[e]; }))
    return;
  for (const EdgeIndex e : loops) {
    admission.admitted[e] = true;
    admission.waiting[e] = false;
  }
}

}  // namespace

Admission RobotFrames::reject(const PoseGraph& graph, Admission before) {
  // Waiting loops are witnesses, too.
  std::vector<bool> admitted = before.admitted;
  for (EdgeIndex e = 0; e < admitted.size(); ++e)
    if (before.waiting[e]) admitted[e] = true;
  const OdometryChains chains(graph);
  DisjointSets frames(static_cast<size_t>(chains.size()));
  int in_world = -1;
  for (int chain = 0; chain < chains.size(); ++chain) {
    // Pieces of one robot's drive need no agreement to be joined.
    if (chain > 0 && chains.first(chain).robot == chains.first(chain - 1).robot)
      frames.join(chain - 1, chain);
    if (!chains.hasPrior(chain)) continue;
    if (in_world >= 0) frames.join(in_world, chain);
    in_world = chain;
  }
  for (EdgeIndex e = 0; e < graph.edges().size(); ++e) {
    const Edge& edge = graph.edges()[e];
    if (edge.pinned && admitted[e]) frames.join(chains.chain(edge.from), chains.chain(edge.to));
  }
  std::vector<FrameAverage> unknown;
  for (const FrameAverage& average : frameAverages(graph, chains, admitted))
    if (!frames.joined(average.a, average.b)) unknown.push_back(average);
  for (const FrameAverage& average : unknown) {
    if (average.agreeing < static_cast<size_t>(options_.min_agreeing)) continue;
    frames.join(average.a, average.b);
    admitWaiting(average, before);
  }
  for (const FrameAverage& average : unknown)
    before.frames.push_back({chains.first(average.a).robot, chains.first(average.b).robot,
                             average.loops, average.agreeing,
                             static_cast<size_t>(options_.min_agreeing),
                             frames.joined(average.a, average.b)});
  for (EdgeIndex e = 0; e < graph.edges().size(); ++e) {
    const Edge& edge = graph.edges()[e];
    if (edge.isLoopClosure() && !edge.pinned &&
        !frames.joined(chains.chain(edge.from), chains.chain(edge.to)))
      before.admitted[e] = before.waiting[e] = false;
  }
  return before;
}

}  // namespace lamp
