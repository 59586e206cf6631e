#pragma once

#include <string>
#include <vector>

#include "lamp/maps/CloudOptions.h"
#include "lamp/maps/MapExporter.h"

namespace lamp {

/** `<stem>.ply`: all keyed scans at the optimised poses as one binary little-endian cloud.
 * Frame of the map, metres; its offset from the world in a line `comment offset X Y Z`; `red green
 * blue` by the option `color`; `nx ny nz` if asked for; `intensity` is there if any scan has it and
 * is NaN for the points of scans that have none. In tiles: docs/maps.md. */
class Ply : public MapExporter {
  DEFINE_MRPT_OBJECT(Ply, lamp)

 public:
  Ply() = default;
  explicit Ply(const CloudOptions& options) : options_(options) {}

  void visit(OptionVisitor& options) override { options_.visit(options); }
  std::vector<std::string> exportMap(const ComponentMap& map, const std::string& stem) override;

 private:
  CloudOptions options_;
};

}  // namespace lamp
