#pragma once

#include "lamp/frontend/OdometrySource.h"

namespace lamp {

/** How far apart the points of a local map should lie, metres: as far as those of its first scan do
 * on surfaces, median, within limits. */
float leafFor(const FilteredScan& scan);

}  // namespace lamp
