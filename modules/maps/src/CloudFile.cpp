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
std::string paddedHeader(const CloudFormat& format, size_t count, bool has_intensity) {
  const size_t longest =
      format.header(std::numeric_limits<size_t>::max(), has_intensity, "").size();
  const size_t bare = format.header(count, has_intensity, "").size();
  return format.header(count, has_intensity, std::string(longest - bare, ' '));
}

CloudPoint cloudPoint(const MapKeyNode& key_node, size_t i, const Eigen::Vector3d& world) {
  const float intensity = key_node.scan->hasIntensity() ? key_node.scan->intensity[i]
                                                        : std::numeric_limits<float>::quiet_NaN();
  return {world.cast<float>(), robotColor(key_node.id.robot), intensity};
}

}  // namespace

void writeCloud(const ComponentMap& map, double voxel_m, const CloudFormat& format,
                const std::string& path) {
  checkMap(map);
  const bool has_intensity = anyIntensity(map);
  std::optional<VoxelSet> voxels;
  if (voxel_m > 0) voxels.emplace(voxel_m);

  writeBinaryFile(path, [&](std::ostream& file) {
    file << paddedHeader(format, 0, has_intensity);
    size_t count = 0;
    std::string bytes;
    forEachPoint(map, [&](const MapKeyNode& key_node, size_t i, const Eigen::Vector3d& world) {
      if (voxels && !voxels->insert(world)) return;
      format.append(cloudPoint(key_node, i, world), has_intensity, bytes);
      ++count;
      if (bytes.size() < kBufferBytes) return;
      file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
      bytes.clear();
    });
    file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    file.seekp(0);
    file << paddedHeader(format, count, has_intensity);
  });
}

}  // namespace lamp
