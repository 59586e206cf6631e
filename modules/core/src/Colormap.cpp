#include "lamp/core/Colormap.h"

#include <algorithm>
#include <cmath>

namespace lamp {

std::array<uint8_t, 3> viridis(double value) {
  const double place = std::clamp(value, 0.0, 1.0) * (kViridis.size() - 1);
  const auto below = std::min(static_cast<size_t>(place), kViridis.size() - 2);
  const double ratio = place - static_cast<double>(below);
  std::array<uint8_t, 3> color;
  for (size_t i = 0; i < color.size(); ++i)
    color[i] = static_cast<uint8_t>(
        std::lround((1 - ratio) * kViridis[below][i] + ratio * kViridis[below + 1][i]));
  return color;
}

}  // namespace lamp
