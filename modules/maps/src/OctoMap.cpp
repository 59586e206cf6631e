#include "lamp/maps/OctoMap.h"

#include "MapPoints.h"
#include "OctreeScanInserter.h"
#include "lamp/core/Files.h"

IMPLEMENTS_MRPT_OBJECT(OctoMap, lamp::MapExporter, lamp)

namespace lamp {

namespace {

void setSensorModel(const OctoMapOptions& options, octomap::OcTree& tree) {
  tree.setProbHit(options.prob_hit);
  tree.setProbMiss(options.prob_miss);
  tree.setClampingThresMin(options.clamping_min);
  tree.setClampingThresMax(options.clamping_max);
  tree.setOccupancyThres(options.occupancy_threshold);
}

/** What OcTree::writeBinary() does, which also prints to the terminal. */
void writeBonsai(octomap::OcTree& tree, std::ostream& file) {
  tree.toMaxLikelihood();
  tree.prune();
  file << "# Octomap OcTree binary file\nid OcTree\nsize " << tree.size() << "\nres "
       << tree.getResolution() << "\ndata\n";
  if (tree.size() > 0) tree.writeBinaryData(file);
}

}  // namespace

std::vector<std::string> OctoMap::exportMap(const ComponentMap& map, const std::string& stem) {
  checkMap(map);
  octomap::OcTree tree(options_.resolution_m);
  setSensorModel(options_, tree);
  OctreeScanInserter inserter(tree, options_.max_range_m);
  for (const MapKeyNode& key_node : map.key_nodes)
    if (key_node.scan) inserter.insert(*key_node.scan, key_node.world_T_base);
  tree.updateInnerOccupancy();
  tree.prune();
  if (inserter.raysOutOfBounds() > 0)
    MRPT_LOG_WARN_FMT("%zu rays reach further than voxels of %g m can number and are left out",
                      inserter.raysOutOfBounds(), options_.resolution_m);

  const std::string log_odds = stem + ".ot", binary = stem + ".bt";
  writeBinaryFile(log_odds, [&](std::ostream& file) { tree.write(file); });
  // Second, because it turns the log-odds in the tree into certain values.
  writeBinaryFile(binary, [&](std::ostream& file) { writeBonsai(tree, file); });
  return {log_odds, binary};
}

}  // namespace lamp
