#pragma once

#include <mrpt/maps/COccupancyGridMap2D.h>

#include <string>
#include <vector>

#include "Storeys.h"

namespace lamp {

/** A storey as a full rectangle of cells. */
struct GridRaster {
  double resolution_m = 0;
  int x = 0, y = 0;  ///< the cell with the least coordinates
  int width = 1, height = 1;
  std::vector<CellState> states{CellState::kUnknown};  ///< rows of rising y

  CellState at(int column, int row) const {
    return states[static_cast<size_t>(row) * static_cast<size_t>(width) +
                  static_cast<size_t>(column)];
  }
};

/** One unknown cell for a storey of which nothing is known. \throws std::runtime_error if the
 * rectangle would be too large. */
GridRaster rasterOf(const Storey& storey, double resolution_m);

/** The image of a map server: a PGM with +x to the right and +y up. \param comment a line, or
 * empty.
 */
std::string toPgm(const GridRaster& raster, const std::string& comment);
/** What a map server needs to know of the image. \param image its path, relative to the text's. */
std::string toMapServerYaml(const GridRaster& raster, const std::string& image,
                            const std::string& comment);
mrpt::maps::COccupancyGridMap2D toMrptGrid(const GridRaster& raster);

}  // namespace lamp
