#include "lamp/maps/Ply.h"

#include "CloudFile.h"

IMPLEMENTS_MRPT_OBJECT(Ply, lamp::MapExporter, lamp)

namespace lamp {

namespace {

void appendPlyColor(Color color, std::string& bytes) {
  for (const uint8_t channel : {color.r, color.g, color.b}) appendBytes(channel, bytes);
}

}  // namespace

std::vector<std::string> Ply::exportMap(const ComponentMap& map, const std::string& stem) {
  constexpr auto kByte = CloudScalar::kUint8;
  const CloudFormat format{"ply",          plyHeader,
                           "mrpt-lamp",    {{"red", kByte}, {"green", kByte}, {"blue", kByte}},
                           appendPlyColor, {{"nx"}, {"ny"}, {"nz"}}};
  return writeCloud(map, options_, format, stem);
}

}  // namespace lamp
