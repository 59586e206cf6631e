#include "CloudFile.h"

#include <algorithm>
#include <limits>
#include <optional>
#include <ostream>

#include "MapPoints.h"
#include "lamp/core/Files.h"
#include "lamp/core/VoxelSet.h"

namespace lamp {

namespace {

constexpr size_t kBufferBytes = 1 << 20;

bool anyIntensity(const ComponentMap& map) {
  return std::any_of(map.key_nodes.begin(), map.key_nodes.end(), [](const MapKeyNode& key_node) {
    return key_node.scan && key_node.scan->hasIntensity();
  });
}

CloudLayout layoutOf(const ComponentMap& map, const CloudFormat& format, bool has_intensity) {
  CloudLayout layout{{format.first_comment}, format.fields, 0};
  if (const std::string offset = offsetComment(map.world_p_origin); !offset.empty())
    layout.comments.push_back(offset);
  if (has_intensity) layout.fields.push_back({"intensity"});
  return layout;
}

/** The count is known only once the points are written, so the header is written twice: as long as
 * for the largest count, then in place with the true one. */
std::string paddedHeader(const CloudFormat& format, CloudLayout layout) {
  const size_t bare = format.header(layout).size();
  CloudLayout longest = layout;
  longest.points = std::numeric_limits<size_t>::max();
  layout.comments.front().append(format.header(longest).size() - bare, ' ');
  return format.header(layout);
}

float intensityOf(const Scan& scan, size_t i) {
  return scan.hasIntensity() ? scan.intensity[i] : std::numeric_limits<float>::quiet_NaN();
}

}  // namespace

void writeCloud(const ComponentMap& map, double voxel_m, const CloudFormat& format,
                const std::string& path) {
  checkMap(map);
  const bool has_intensity = anyIntensity(map);
  CloudLayout layout = layoutOf(map, format, has_intensity);
  std::optional<VoxelSet> voxels;
  if (voxel_m > 0) voxels.emplace(voxel_m);

  writeBinaryFile(path, [&](std::ostream& file) {
    file << paddedHeader(format, layout);
    std::string bytes;
    forEachPoint(map, [&](const MapKeyNode& key_node, size_t i, const Eigen::Vector3d& position) {
      if (voxels && !voxels->insert(position)) return;
      format.append({position.cast<float>(), robotColor(key_node.id.robot)}, bytes);
      if (has_intensity) appendBytes(intensityOf(*key_node.scan, i), bytes);
      ++layout.points;
      if (bytes.size() < kBufferBytes) return;
      file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
      bytes.clear();
    });
    file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    file.seekp(0);
    file << paddedHeader(format, layout);
  });
}

}  // namespace lamp
