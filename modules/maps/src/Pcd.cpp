#include "lamp/maps/Pcd.h"

#include "CloudFile.h"

IMPLEMENTS_MRPT_OBJECT(Pcd, lamp::MapExporter, lamp)

namespace lamp {

namespace {

/** PCL reads the bits of a float as 0x00rrggbb. */
uint32_t packedRgb(Color color) {
  return (uint32_t{color.r} << 16) | (uint32_t{color.g} << 8) | color.b;
}

void appendPcdPoint(const CloudPoint& point, std::string& bytes) {
  appendBytes(point.position, bytes);
  appendBytes(packedRgb(point.color), bytes);
}

}  // namespace

std::vector<std::string> Pcd::exportMap(const ComponentMap& map, const std::string& stem) {
  const std::string path = stem + ".pcd";
  const CloudFormat format{pcdHeader,
                           ".PCD v0.7 - Point Cloud Data file format",
                           {{"x"}, {"y"}, {"z"}, {"rgb"}},
                           appendPcdPoint};
  writeCloud(map, options_.voxel_m, format, path);
  return {path};
}

}  // namespace lamp
