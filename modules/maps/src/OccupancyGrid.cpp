#include "lamp/maps/OccupancyGrid.h"

#include <mrpt/io/CMemoryStream.h>
#include <mrpt/serialization/CArchive.h>

#include <algorithm>
#include <filesystem>

#include "GridFiles.h"
#include "OccupiedSpace.h"
#include "lamp/core/CloudHeader.h"
#include "lamp/core/Files.h"

IMPLEMENTS_MRPT_OBJECT(OccupancyGrid, lamp::MapExporter, lamp)

namespace lamp {

namespace fs = std::filesystem;

namespace {

std::string serialized(const mrpt::serialization::CSerializable& object) {
  mrpt::io::CMemoryStream memory;
  mrpt::serialization::archiveFrom(memory) << object;
  return {static_cast<const char*>(memory.getRawBufferData()), memory.getTotalBytesCount()};
}

/** \return the files written. */
std::vector<std::string> writeGrid(const GridRaster& raster, const std::string& comment,
                                   const std::string& stem) {
  const std::string image = stem + ".pgm", yaml = stem + ".yaml", gridmap = stem + ".gridmap";
  writeTextFile(image, toPgm(raster, comment));
  writeTextFile(yaml, toMapServerYaml(raster, fs::path(image).filename().string(), comment));
  writeTextFile(gridmap, serialized(toMrptGrid(raster)));
  return {image, yaml, gridmap};
}

}  // namespace

std::vector<std::string> OccupancyGrid::exportMap(const ComponentMap& map,
                                                  const std::string& stem) {
  const std::vector<Storey>& storeys = map.occupancy->of(map).storeys();
  std::vector<std::string> files;
  for (size_t k = 0; k < storeys.size(); ++k) {
    const std::string name = k == 0 ? stem : stem + ".storey" + std::to_string(k);
    for (std::string& file : writeGrid(rasterOf(storeys[k], map.occupancy->options().resolution_m),
                                       offsetComment(map.world_p_origin), name))
      files.push_back(std::move(file));
  }
  // Storeys of an earlier state of the map that turned out to be none.
  for (const std::string& old : written_[stem])
    if (std::find(files.begin(), files.end(), old) == files.end()) fs::remove(old);
  return written_[stem] = files;
}

}  // namespace lamp
