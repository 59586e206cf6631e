#include "lamp/maps/Ply.h"

#include "CloudFile.h"

IMPLEMENTS_MRPT_OBJECT(Ply, lamp::MapExporter, lamp)

namespace lamp {

namespace {

std::string plyHeader(size_t count, bool has_intensity, const std::string& padding) {
  std::string header = "ply\nformat binary_little_endian 1.0\ncomment mrpt-lamp" + padding +
                       "\nelement vertex " + std::to_string(count) +
                       "\nproperty float x\nproperty float y\nproperty float z"
                       "\nproperty uchar red\nproperty uchar green\nproperty uchar blue\n";
  if (has_intensity) header += "property float intensity\n";
  return header + "end_header\n";
}

void appendPlyPoint(const CloudPoint& point, bool has_intensity, std::string& bytes) {
  for (const float coordinate : point.position) appendBytes(coordinate, bytes);
  for (const uint8_t channel : {point.color.r, point.color.g, point.color.b})
    appendBytes(channel, bytes);
  if (has_intensity) appendBytes(point.intensity, bytes);
}

}  // namespace

std::vector<std::string> Ply::exportMap(const ComponentMap& map, const std::string& stem) {
  const std::string path = stem + ".ply";
  writeCloud(map, options_.voxel_m, {plyHeader, appendPlyPoint}, path);
  return {path};
}

}  // namespace lamp
