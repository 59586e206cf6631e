#pragma once

#include <mrpt/img/CImage.h>

#include <string>
#include <vector>

#include "TopView.h"
#include "lamp/maps/MapExporter.h"

namespace lamp {

struct LegendEntry {
  Color color;
  std::string text;
};

/** What the picture's colours mean, in lines that fit a width, and a scale bar at the right. */
class Legend {
 public:
  Legend(std::vector<LegendEntry> entries, const TopView& view, int width_px);

  int height() const;
  void draw(mrpt::img::CImage& image, int x0, int y0) const;

 private:
  struct Place {
    int column_px, row;
  };
  void drawScaleBar(mrpt::img::CImage& image, int right, int y0) const;

  std::vector<LegendEntry> entries_;
  std::vector<Place> places_;
  int width_px_;
  double pixel_m_;
  double bar_m_;
  int rows_ = 1;
};

/** Largest of 1, 2, 5 times a power of ten that is not above `length`. */
double roundLength(double length);

constexpr Color kAcceptedColor{0, 160, 60};
constexpr Color kRejectedColor{214, 39, 40};
constexpr Color kPendingColor{230, 160, 0};
/** Robots with their key nodes, then loop closures by verdict. */
std::vector<LegendEntry> legendOf(const ComponentMap& map);

}  // namespace lamp
