#include "CloudFile.h"

#include <algorithm>
#include <limits>
#include <optional>
#include <ostream>

#include "MapPoints.h"
#include "VoxelSet.h"
#include "lamp/core/Files.h"

namespace lamp {

namespace {

constexpr size_t kBufferBytes = 1 << 20;

bool anyIntensity(const ComponentMap& map) {
  return std::any_of(map.key_nodes.begin(), map.key_nodes.end(), [](const MapKeyNode& key_node) {
    return key_node.scan && key_node.scan->hasIntensity();
  });
}

/** The count is known only once the points are written, so the header is written twice: as long as
 * for the largest count, then in place with the true one. */
std::string paddedHeader(const CloudFormat& format, CloudHeader header) {
  const size_t bare = format.header(header).size();
  CloudHeader longest = header;
  longest.count = std::numeric_limits<size_t>::max();
  header.padding.assign(format.header(longest).size() - bare, ' ');
  return format.header(header);
}

CloudPoint cloudPoint(const MapKeyNode& key_node, size_t i, const Eigen::Vector3d& position) {
  const float intensity = key_node.scan->hasIntensity() ? key_node.scan->intensity[i]
                                                        : std::numeric_limits<float>::quiet_NaN();
  return {position.cast<float>(), robotColor(key_node.id.robot), intensity};
}

}  // namespace

void writeCloud(const ComponentMap& map, double voxel_m, const CloudFormat& format,
                const std::string& path) {
  checkMap(map);
  CloudHeader header{0, anyIntensity(map), offsetText(map), ""};
  std::optional<VoxelSet> voxels;
  if (voxel_m > 0) voxels.emplace(voxel_m);

  writeBinaryFile(path, [&](std::ostream& file) {
    file << paddedHeader(format, header);
    std::string bytes;
    forEachPoint(map, [&](const MapKeyNode& key_node, size_t i, const Eigen::Vector3d& position) {
      if (voxels && !voxels->insert(position)) return;
      format.append(cloudPoint(key_node, i, position), header.has_intensity, bytes);
      ++header.count;
      if (bytes.size() < kBufferBytes) return;
      file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
      bytes.clear();
    });
    file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    file.seekp(0);
    file << paddedHeader(format, header);
  });
}

}  // namespace lamp
