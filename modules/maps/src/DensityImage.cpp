#include "DensityImage.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace lamp {

namespace {

/** Share of the points that lie in pixels paler than full ink. Of the points, not of the pixels:
 * walls have few pixels, floors many. */
constexpr double kFullShare = 0.95;
/** Shade of a lone point, which must not be lost on the paper. */
constexpr float kFaintest = 0.15f;
constexpr float kPaper = 255.0f;
constexpr float kGreyInk = 40.0f;
/** How much of the ink is the robots' colour; the rest is black. */
constexpr float kTintShare = 0.62f;

uint8_t blendInk(float ink, float shade) {
  return static_cast<uint8_t>(std::lround(kPaper + (ink - kPaper) * shade));
}

}  // namespace

DensityImage::DensityImage(const TopView& view)
    : view_(view), pixels_(static_cast<size_t>(view.width) * view.height) {}

void DensityImage::add(const Eigen::Vector3d& world, Color color) {
  const Eigen::Vector2d at = view_.toPixel(world);
  if (!(at.x() >= 0 && at.x() < view_.width && at.y() >= 0 && at.y() < view_.height)) return;
  Pixel& pixel = pixels_[static_cast<size_t>(at.y()) * view_.width + static_cast<size_t>(at.x())];
  pixel.count += 1;
  pixel.r += color.r;
  pixel.g += color.g;
  pixel.b += color.b;
}

float DensityImage::fullCount() const {
  std::vector<float> counts;
  for (const Pixel& pixel : pixels_)
    if (pixel.count > 0) counts.push_back(pixel.count);
  std::sort(counts.begin(), counts.end());
  const double points = std::accumulate(counts.begin(), counts.end(), 0.0);
  double below = 0;
  for (const float count : counts)
    if ((below += count) >= kFullShare * points) return count;
  return 1;
}

void DensityImage::draw(mrpt::img::CImage& image, int x0, int y0, bool tint) const {
  const float full = std::log1p(fullCount());
  for (int y = 0; y < view_.height; ++y) {
    uint8_t* row = image.ptrLine<uint8_t>(y0 + y) + 3 * x0;
    for (int x = 0; x < view_.width; ++x) {
      const Pixel& pixel = pixels_[static_cast<size_t>(y) * view_.width + x];
      if (pixel.count == 0) continue;
      const float shade =
          kFaintest + (1 - kFaintest) * std::min(1.0f, std::log1p(pixel.count) / full);
      const float share = kTintShare / pixel.count;
      const std::array<float, 3> bgr{pixel.b, pixel.g, pixel.r};
      for (int channel = 0; channel < 3; ++channel)
        row[3 * x + channel] = blendInk(tint ? bgr[channel] * share : kGreyInk, shade);
    }
  }
}

}  // namespace lamp
