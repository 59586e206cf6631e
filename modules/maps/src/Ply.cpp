#include "lamp/maps/Ply.h"

#include "CloudFile.h"

IMPLEMENTS_MRPT_OBJECT(Ply, lamp::MapExporter, lamp)

namespace lamp {

namespace {

std::string plyHeader(const CloudHeader& header) {
  std::string text = "ply\nformat binary_little_endian 1.0\ncomment mrpt-lamp" + header.padding;
  if (!header.offset.empty()) text += "\ncomment " + header.offset;
  text += "\nelement vertex " + std::to_string(header.count) +
          "\nproperty float x\nproperty float y\nproperty float z"
          "\nproperty uchar red\nproperty uchar green\nproperty uchar blue\n";
  if (header.has_intensity) text += "property float intensity\n";
  return text + "end_header\n";
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
