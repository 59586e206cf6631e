#pragma once

#include <string>
#include <vector>

#include "lamp/maps/MapExporter.h"

namespace lamp {

/** `<stem>.ot` (log-odds) and `<stem>.bt` (occupied, free, unknown): occupancy in the format of
 * Hornung et al., "OctoMap", Autonomous Robots 2013. Frame of the map, metres; its offset from the
 * world in a line `# offset X Y Z`. The model: docs/maps.md. */
class OctoMap : public MapExporter {
  DEFINE_MRPT_OBJECT(OctoMap, lamp)

 public:
  void visit(OptionVisitor&) override {}
  std::vector<std::string> exportMap(const ComponentMap& map, const std::string& stem) override;
};

}  // namespace lamp
