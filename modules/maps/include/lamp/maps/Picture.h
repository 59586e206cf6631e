#pragma once

#include <string>
#include <vector>

#include "lamp/maps/MapExporter.h"

namespace lamp {

struct PictureOptions {
  int size_px = 1600;
  double finest_pixel_m = 0.02;
  bool tint = true;
  bool rejected_loops = true;

  void visit(OptionVisitor& v) {
    v("size_px", size_px, "px", "length of the picture's longer side", Range{100, 8000});
    v("finest_pixel_m", finest_pixel_m, "m",
      "minimum size of a pixel in metres; small maps give small pictures rather than dotted walls",
      kPositive);
    v("tint", tint, "shade points in the colours of the robots that saw them");
    v("rejected_loops", rejected_loops, "draw rejected loop closures");
  }
};

/** `<stem>.png`: the map from above, +x to the right and +y up, drawn in software.
 *
 * Each pixel is the darker the more points fall into it, on a log scale. On top: rejected and
 * accepted loop closures in red and green, the trajectories in the robots' colours with a ring at
 * the start, a legend and a scale bar. The frame leaves out the outermost 0.1 % of the points on
 * each side. */
class Picture : public MapExporter {
  DEFINE_MRPT_OBJECT(Picture, lamp)

 public:
  Picture() = default;
  explicit Picture(const PictureOptions& options) : options_(options) {}

  void visit(OptionVisitor& options) override { options_.visit(options); }
  std::vector<std::string> exportMap(const ComponentMap& map, const std::string& stem) override;

 private:
  PictureOptions options_;
};

}  // namespace lamp
