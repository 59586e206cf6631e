#include "lamp/maps/OctoMap.h"

#include "OccupiedSpace.h"
#include "OctreeFile.h"
#include "lamp/core/CloudHeader.h"
#include "lamp/core/Files.h"

IMPLEMENTS_MRPT_OBJECT(OctoMap, lamp::MapExporter, lamp)

namespace lamp {

std::vector<std::string> OctoMap::exportMap(const ComponentMap& map, const std::string& stem) {
  const VoxelStates& states = map.occupancy->of(map).states();
  const double resolution_m = map.occupancy->options().resolution_m;
  const std::string log_odds = stem + ".ot", binary = stem + ".bt",
                    offset = offsetComment(map.world_p_origin);
  writeBinaryFile(log_odds,
                  [&](std::ostream& file) { writeLogOdds(states, resolution_m, offset, file); });
  writeBinaryFile(binary,
                  [&](std::ostream& file) { writeBonsai(states, resolution_m, offset, file); });
  return {log_odds, binary};
}

}  // namespace lamp
