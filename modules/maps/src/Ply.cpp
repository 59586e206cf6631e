#include "lamp/maps/Ply.h"

#include "CloudFile.h"

IMPLEMENTS_MRPT_OBJECT(Ply, lamp::MapExporter, lamp)

namespace lamp {

namespace {

void appendPlyPoint(const CloudPoint& point, std::string& bytes) {
  appendBytes(point.position, bytes);
  for (const uint8_t channel : {point.color.r, point.color.g, point.color.b})
    appendBytes(channel, bytes);
}

}  // namespace

std::vector<std::string> Ply::exportMap(const ComponentMap& map, const std::string& stem) {
  const std::string path = stem + ".ply";
  constexpr auto kByte = CloudScalar::kUint8;
  const CloudFormat format{plyHeader,
                           "mrpt-lamp",
                           {{"x"}, {"y"}, {"z"}, {"red", kByte}, {"green", kByte}, {"blue", kByte}},
                           appendPlyPoint};
  writeCloud(map, options_.voxel_m, format, path);
  return {path};
}

}  // namespace lamp
