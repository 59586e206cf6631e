#pragma once

#include <map>
#include <string>
#include <vector>

#include "lamp/maps/MapExporter.h"

namespace lamp {

/** The layer in which the robots drive, cut out of the occupancy, as a grid for planners in the
 * plane: `<stem>.pgm` with `<stem>.yaml` as ROS's map servers read them, and `<stem>.gridmap`, a
 * mrpt::maps::COccupancyGridMap2D. The grid follows the ground; of storeys above each other the
 * first is that on which the first robot started, and the others are `<stem>.storey<k>.*`. Frame of
 * the map, metres; its offset from the world in a line `# offset X Y Z`. The rules: docs/maps.md.
 */
class OccupancyGrid : public MapExporter {
  DEFINE_MRPT_OBJECT(OccupancyGrid, lamp)

 public:
  void visit(OptionVisitor&) override {}
  std::vector<std::string> exportMap(const ComponentMap& map, const std::string& stem) override;

 private:
  std::map<std::string, std::vector<std::string>> written_;  ///< files, by stem
};

}  // namespace lamp
