#pragma once

#include <string>

#include "CloudPoints.h"

namespace lamp {

/** Colours of a map's points by one property; numbers from low to high in viridis. */
class PointColors {
 public:
  /** \param property `robot`, `intensity`, `height` or `time`. \param map must outlive this. */
  PointColors(const ComponentMap& map, const std::string& property);

  /** Grey where the point's scan has no intensity. */
  Color of(const CloudPoint& point) const;

 private:
  using Value = double (*)(const CloudPoint&, const ComponentMap&);

  const ComponentMap& map_;
  Value value_ = nullptr;  ///< null for the robot
  double low_ = 0, high_ = 1;
};

}  // namespace lamp
