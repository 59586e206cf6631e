#pragma once

#include <mrpt/img/CImage.h>

#include <Eigen/Core>
#include <vector>

#include "lamp/maps/MapExporter.h"

namespace lamp {

/** Draws smooth lines into a rectangle of a colour image; what lies outside is cut off. Coordinates
 * are in pixels from the rectangle's top left corner. */
class LinePen {
 public:
  LinePen(mrpt::img::CImage& image, int x0, int y0, int width, int height)
      : image_(image), x0_(x0), y0_(y0), width_(width), height_(height) {}

  void line(const Eigen::Vector2d& a, const Eigen::Vector2d& b, Color color, double width_px,
            double opacity = 1.0);
  void polyline(const std::vector<Eigen::Vector2d>& points, Color color, double width_px);
  void dot(const Eigen::Vector2d& centre, Color color, double diameter_px, double opacity) {
    line(centre, centre, color, diameter_px, opacity);
  }
  void ring(const Eigen::Vector2d& centre, double radius_px, Color color, double width_px);

 private:
  void blend(int x, int y, Color color, double opacity);

  mrpt::img::CImage& image_;
  int x0_, y0_, width_, height_;
};

}  // namespace lamp
