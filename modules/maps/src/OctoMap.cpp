#include "lamp/maps/OctoMap.h"

#include "MapPoints.h"
#include "OctreeScanInserter.h"
#include "lamp/core/CloudHeader.h"
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

/** OctoMap's own writers have no place for comments, and print to the terminal. */
void writeHeader(const octomap::OcTree& tree, const std::string& kind, const std::string& offset,
                 std::ostream& file) {
  file << "# Octomap OcTree " << kind << "\n";
  if (!offset.empty()) file << "# " << offset << "\n";
  file << "id OcTree\nsize " << tree.size() << "\nres " << tree.getResolution() << "\ndata\n";
}

void writeLogOdds(octomap::OcTree& tree, const std::string& offset, std::ostream& file) {
  writeHeader(tree, "file", offset, file);
  tree.writeData(file);
}

void writeBonsai(octomap::OcTree& tree, const std::string& offset, std::ostream& file) {
  tree.toMaxLikelihood();
  tree.prune();
  writeHeader(tree, "binary file", offset, file);
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
    MRPT_LOG_WARN_FMT(
        "%zu rays end beyond the range of an octree with voxels of %g m and are left out",
        inserter.raysOutOfBounds(), options_.resolution_m);

  const std::string log_odds = stem + ".ot", binary = stem + ".bt",
                    offset = offsetComment(map.world_p_origin);
  writeBinaryFile(log_odds, [&](std::ostream& file) { writeLogOdds(tree, offset, file); });
  // Second, because it turns the log-odds in the tree into certain values.
  writeBinaryFile(binary, [&](std::ostream& file) { writeBonsai(tree, offset, file); });
  return {log_odds, binary};
}

}  // namespace lamp
