#include "GridFiles.h"

#include <algorithm>
#include <iomanip>
#include <sstream>
#include <stdexcept>

namespace lamp {

namespace {

/** As ROS's own map savers write them. Between the thresholds a cell is unknown, and so is 205. */
constexpr int kWhiteIfFree = 254, kBlackIfOccupied = 0, kGreyIfUnknown = 205;
constexpr const char *kOccupiedThreshold = "0.65", *kFreeThreshold = "0.196";

char grayOf(CellState state) {
  const int gray = state == CellState::kFree       ? kWhiteIfFree
                   : state == CellState::kOccupied ? kBlackIfOccupied
                                                   : kGreyIfUnknown;
  return static_cast<char>(gray);
}

std::string commentLine(const std::string& comment) {
  return comment.empty() ? "" : "# " + comment + "\n";
}

}  // namespace

GridRaster rasterOf(const Storey& storey, double resolution_m) {
  Eigen::AlignedBox2i box;
  for (const StoreyCell& cell : storey.cells)
    if (cell.state != CellState::kUnknown) box.extend(Eigen::Vector2i(cell.ground.head<2>()));
  GridRaster raster;
  raster.resolution_m = resolution_m;
  if (box.isEmpty()) return raster;
  raster.x = box.min().x();
  raster.y = box.min().y();
  raster.width = box.sizes().x() + 1;
  raster.height = box.sizes().y() + 1;
  const size_t cells = static_cast<size_t>(raster.width) * static_cast<size_t>(raster.height);
  constexpr size_t kMostCells = 1 << 29;
  if (cells > kMostCells)
    throw std::runtime_error("a grid of " + std::to_string(raster.width) + " x " +
                             std::to_string(raster.height) +
                             " cells is too large: raise [occupancy] resolution_m");
  raster.states.assign(cells, CellState::kUnknown);
  for (const StoreyCell& cell : storey.cells) {
    if (cell.state == CellState::kUnknown) continue;
    const auto row = static_cast<size_t>(cell.ground.y() - raster.y),
               column = static_cast<size_t>(cell.ground.x() - raster.x);
    raster.states[row * static_cast<size_t>(raster.width) + column] = cell.state;
  }
  return raster;
}

std::string toPgm(const GridRaster& raster, const std::string& comment) {
  std::string image = "P5\n" + commentLine(comment) + std::to_string(raster.width) + " " +
                      std::to_string(raster.height) + "\n255\n";
  image.reserve(image.size() + raster.states.size());
  for (int row = raster.height - 1; row >= 0; --row)
    for (int column = 0; column < raster.width; ++column) image += grayOf(raster.at(column, row));
  return image;
}

std::string toMapServerYaml(const GridRaster& raster, const std::string& image,
                            const std::string& comment) {
  std::ostringstream text;
  text << std::setprecision(12) << commentLine(comment) << "image: " << image
       << "\nmode: trinary\nresolution: " << raster.resolution_m << "\norigin: ["
       << raster.x * raster.resolution_m << ", " << raster.y * raster.resolution_m
       << ", 0]\nnegate: 0\noccupied_thresh: " << kOccupiedThreshold
       << "\nfree_thresh: " << kFreeThreshold << "\n";
  return text.str();
}

mrpt::maps::COccupancyGridMap2D toMrptGrid(const GridRaster& raster) {
  const auto edge = [&](int cells) { return static_cast<float>(cells * raster.resolution_m); };
  mrpt::maps::COccupancyGridMap2D grid(edge(raster.x), edge(raster.x + raster.width),
                                       edge(raster.y), edge(raster.y + raster.height),
                                       static_cast<float>(raster.resolution_m));
  grid.fill(0.5f);
  for (int row = 0; row < raster.height; ++row)
    for (int column = 0; column < raster.width; ++column)
      if (const CellState state = raster.at(column, row); state != CellState::kUnknown)
        grid.setCell(column, row, state == CellState::kFree ? 1.0f : 0.0f);
  return grid;
}

}  // namespace lamp
