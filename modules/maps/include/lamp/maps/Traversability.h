#pragma once

#include <string>
#include <vector>

#include "lamp/maps/MapExporter.h"

namespace lamp {

/** `<stem>.ground.pcd`: the ground where it was seen, one point a cell of the grids, with `step`
 * and `clearance` in metres, `slope` in degrees, `cost` from 0 (easy) to 1 (no robot of
 * `[occupancy]` gets there), and `storey`. Frame of the map, metres; its offset from the world in a
 * line `# offset X Y Z`. What cannot be told is NaN. The rules: docs/maps.md. */
class Traversability : public MapExporter {
  DEFINE_MRPT_OBJECT(Traversability, lamp)

 public:
  void visit(OptionVisitor&) override {}
  std::vector<std::string> exportMap(const ComponentMap& map, const std::string& stem) override;
};

}  // namespace lamp
