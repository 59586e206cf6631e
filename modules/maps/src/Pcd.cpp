#include "lamp/maps/Pcd.h"

#include "CloudFile.h"

IMPLEMENTS_MRPT_OBJECT(Pcd, lamp::MapExporter, lamp)

namespace lamp {

namespace {

std::string pcdHeader(const CloudHeader& header) {
  const std::string n = std::to_string(header.count);
  const std::string offset = header.offset.empty() ? "" : "\n# " + header.offset;
  const std::string fields = header.has_intensity ? "FIELDS x y z rgb intensity\nSIZE 4 4 4 4 4\n"
                                                    "TYPE F F F F F\nCOUNT 1 1 1 1 1\n"
                                                  : "FIELDS x y z rgb\nSIZE 4 4 4 4\n"
                                                    "TYPE F F F F\nCOUNT 1 1 1 1\n";
  return "# .PCD v0.7 - Point Cloud Data file format" + header.padding + offset +
         "\nVERSION 0.7\n" + fields + "WIDTH " + n +
         "\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS " + n + "\nDATA binary\n";
}

/** PCL reads the bits of a float as 0x00rrggbb. */
uint32_t packedRgb(Color color) {
  return (uint32_t{color.r} << 16) | (uint32_t{color.g} << 8) | color.b;
}

void appendPcdPoint(const CloudPoint& point, bool has_intensity, std::string& bytes) {
  for (const float coordinate : point.position) appendBytes(coordinate, bytes);
  appendBytes(packedRgb(point.color), bytes);
  if (has_intensity) appendBytes(point.intensity, bytes);
}

}  // namespace

std::vector<std::string> Pcd::exportMap(const ComponentMap& map, const std::string& stem) {
  const std::string path = stem + ".pcd";
  writeCloud(map, options_.voxel_m, {pcdHeader, appendPcdPoint}, path);
  return {path};
}

}  // namespace lamp
