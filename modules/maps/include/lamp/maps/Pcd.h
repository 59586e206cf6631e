#pragma once

#include <string>
#include <vector>

#include "lamp/maps/CloudOptions.h"
#include "lamp/maps/MapExporter.h"

namespace lamp {

/** `<stem>.pcd`: all keyed scans at the optimised poses as one binary cloud for PCL. Frame of
 * the map, metres; its offset from the world in a line `# offset X Y Z`; `rgb` by the option
 * `color`, packed as PCL does; `normal_x normal_y normal_z` if asked for; `intensity` is there if
 * any scan has it and is NaN for the points of scans that have none. In tiles: docs/maps.md. */
class Pcd : public MapExporter {
  DEFINE_MRPT_OBJECT(Pcd, lamp)

 public:
  Pcd() = default;
  explicit Pcd(const CloudOptions& options) : options_(options) {}

  void visit(OptionVisitor& options) override { options_.visit(options); }
  std::vector<std::string> exportMap(const ComponentMap& map, const std::string& stem) override;

 private:
  CloudOptions options_;
};

}  // namespace lamp
