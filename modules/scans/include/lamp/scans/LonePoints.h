#pragma once

#include "lamp/core/KeyedScan.h"

namespace lamp {

/** The scan without the points that have no other one near: none in their own or a neighbouring
 * cell of a grid. Rain, dust and false returns leave such points, and no voxel filter thins them.
 * Points that no voxel filter takes are left out, too.
 * \param cell_m edge of a cell, metres; every point with another one within it stays. */
Scan withoutLonePoints(const Scan& scan, double cell_m);

}  // namespace lamp
