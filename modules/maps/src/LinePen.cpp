#include "LinePen.h"

#include <algorithm>
#include <cmath>

namespace lamp {

namespace {

/** Shorter segments add nothing but overlapping ends. */
constexpr double kLeastSegment_px = 1.0;

double distanceToSegment(const Eigen::Vector2d& p, const Eigen::Vector2d& a,
                         const Eigen::Vector2d& b) {
  const Eigen::Vector2d ab = b - a;
  const double length2 = ab.squaredNorm();
  const double t = length2 > 0 ? std::clamp((p - a).dot(ab) / length2, 0.0, 1.0) : 0.0;
  return (p - a - t * ab).norm();
}

/** Share of a pixel that a line covers whose middle is `distance` away. */
double coverage(double distance, double width) {
  return std::clamp(width / 2 + 0.5 - distance, 0.0, 1.0);
}

}  // namespace

void LinePen::line(const Eigen::Vector2d& a, const Eigen::Vector2d& b, Color color, double width_px,
                   double opacity) {
  // Walks along the axis that the line follows more, and there over the few pixels across.
  const int along = std::abs(b.x() - a.x()) >= std::abs(b.y() - a.y()) ? 0 : 1, across = 1 - along;
  const Eigen::Vector2d d = b - a;
  const double slope = d[along] != 0 ? d[across] / d[along] : 0;
  const double reach = (width_px / 2 + 1) * std::sqrt(1 + slope * slope);
  const int size[2] = {width_, height_};
  const auto first = [](double from) { return static_cast<int>(std::floor(std::max(0.0, from))); };
  const auto last = [](double to, int end) {
    return static_cast<int>(std::floor(std::min(to, end - 1.0)));
  };
  const double low = std::min(a[along], b[along]) - reach;
  const double high = std::max(a[along], b[along]) + reach;
  for (int u = first(low); u <= last(high, size[along]); ++u) {
    const double middle = a[across] + slope * (u + 0.5 - a[along]);
    for (int v = first(middle - reach); v <= last(middle + reach, size[across]); ++v) {
      Eigen::Vector2i pixel;
      pixel[along] = u;
      pixel[across] = v;
      const Eigen::Vector2d centre = pixel.cast<double>().array() + 0.5;
      blend(pixel.x(), pixel.y(), color,
            opacity * coverage(distanceToSegment(centre, a, b), width_px));
    }
  }
}

void LinePen::polyline(const std::vector<Eigen::Vector2d>& points, Color color, double width_px) {
  for (size_t i = 1, start = 0; i < points.size(); ++i) {
    const bool is_last = i + 1 == points.size();
    if (!is_last && (points[i] - points[start]).norm() < kLeastSegment_px) continue;
    line(points[start], points[i], color, width_px);
    start = i;
  }
}

void LinePen::ring(const Eigen::Vector2d& centre, double radius_px, Color color, double width_px) {
  const double reach = radius_px + width_px;
  const Eigen::Vector2d size(width_, height_);
  const Eigen::Vector2d low = (centre.array() - reach).floor().cwiseMax(0);
  const Eigen::Vector2d high = (centre.array() + reach).ceil().min(size.array() - 1);
  for (int y = static_cast<int>(low.y()); y <= high.y(); ++y)
    for (int x = static_cast<int>(low.x()); x <= high.x(); ++x) {
      const double radius = (Eigen::Vector2d(x + 0.5, y + 0.5) - centre).norm();
      blend(x, y, color, coverage(std::abs(radius - radius_px), width_px));
    }
}

void LinePen::blend(int x, int y, Color color, double opacity) {
  if (opacity <= 0) return;
  uint8_t* pixel = image_.ptrLine<uint8_t>(y0_ + y) + 3 * (x0_ + x);
  const uint8_t bgr[3] = {color.b, color.g, color.r};
  for (int c = 0; c < 3; ++c)
    pixel[c] = static_cast<uint8_t>(std::lround(pixel[c] + (bgr[c] - pixel[c]) * opacity));
}

}  // namespace lamp
