#include "FuzzTarget.h"
#include "lamp/core/G2oFile.h"

using namespace lamp;

/** A graph that was read can be written, and what was written can be read. */
extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  fuzz::mayRefuse("fuzz.g2o", [&] {
    const G2oGraph g2o = g2oFromText(fuzz::textOf(data, size), "fuzz.g2o");
    for (const Node& node : g2o.graph.nodes())
      fuzz::require(node.world_T_base.matrix().allFinite(), "finite poses");
    for (const Edge& edge : g2o.graph.edges())
      fuzz::require(edge.from_T_to.matrix().allFinite() && edge.information.allFinite(),
                    "finite edges");
    const G2oGraph again = g2oFromText(toG2o(g2o), "again.g2o");
    fuzz::require(again.ids == g2o.ids, "the same nodes after a round trip");
  });
  return 0;
}
