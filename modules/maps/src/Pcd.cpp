#include "lamp/maps/Pcd.h"

#include "CloudFile.h"

IMPLEMENTS_MRPT_OBJECT(Pcd, lamp::MapExporter, lamp)

namespace lamp {

namespace {

/** PCL reads the bits of a float as 0x00rrggbb. */
uint32_t packedRgb(Color color) {
  return (uint32_t{color.r} << 16) | (uint32_t{color.g} << 8) | color.b;
}

void appendPcdColor(Color color, std::string& bytes) {
  appendBytes(packedRgb(color), bytes);
}

}  // namespace

std::vector<std::string> Pcd::exportMap(const ComponentMap& map, const std::string& stem) {
  const CloudFormat format{"pcd",     pcdHeader,      ".PCD v0.7 - Point Cloud Data file format",
                           {{"rgb"}}, appendPcdColor, {{"normal_x"}, {"normal_y"}, {"normal_z"}}};
  return writeCloud(map, options_, format, stem);
}

}  // namespace lamp
