#include "CloudFile.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <optional>
#include <ostream>

#include "CloudTiles.h"
#include "MapPoints.h"
#include "OccupiedSpace.h"
#include "PointColors.h"
#include "SolidPoints.h"
#include "lamp/core/Csv.h"
#include "lamp/core/Files.h"

namespace lamp {

namespace {

namespace fs = std::filesystem;

constexpr double kPieceM = 32;  ///< side of the pieces in which one file is made
constexpr double kMarginM = 1;  ///< around a piece, for the normals at its edge
constexpr size_t kBufferBytes = 1 << 20;

bool anyIntensity(const ComponentMap& map) {
  return std::any_of(map.key_nodes.begin(), map.key_nodes.end(), [](const MapKeyNode& key_node) {
    return key_node.scan && key_node.scan->hasIntensity();
  });
}

/** A whole number of voxels, so that no voxel lies in two tiles. */
double sideOf(const CloudOptions& options) {
  const double side_m = options.tile_m > 0 ? options.tile_m : kPieceM;
  return options.voxel_m > 0 ? std::max(1.0, std::round(side_m / options.voxel_m)) * options.voxel_m
                             : side_m;
}

/** The points of a map, piece by piece, and what is written of each. */
class Cloud {
 public:
  Cloud(const ComponentMap& map, const CloudOptions& options, const CloudFormat& format)
      : map_(map),
        options_(options),
        format_(format),
        has_intensity_(anyIntensity(map)),
        colors_(map, options.color),
        tiles_(map, sideOf(options), options.normals ? kMarginM : 0) {
    if (options.moving) return;
    solid_.emplace(map.occupancy->of(map).states(), map.occupancy->options());
  }

  const CloudTiles& tiles() const { return tiles_; }

  CloudLayout layout() const {
    CloudLayout layout{{format_.first_comment}, {{"x"}, {"y"}, {"z"}}, 0};
    if (const std::string offset = offsetComment(map_.world_p_origin); !offset.empty())
      layout.comments.push_back(offset);
    const auto add = [&](const std::vector<CloudField>& fields) {
      layout.fields.insert(layout.fields.end(), fields.begin(), fields.end());
    };
    add(format_.color_fields);
    if (options_.normals) add(format_.normal_fields);
    if (has_intensity_) add({{"intensity"}});
    return layout;
  }

  /** Calls `visit(bytes, position)` for each point of a tile. */
  template <class Visit>
  void forEachPointOf(const CloudTiles::Tile& tile, Visit&& visit) const {
    std::vector<CloudPoint> points = tiles_.points(
        tile, [&](const CloudPoint& point) { return !solid_ || solid_->isSolid(point, map_); });
    if (options_.voxel_m > 0) thinToMeans(points, options_.voxel_m);
    std::vector<Eigen::Vector3f> normals;
    if (options_.normals) normals = normalsOf(points, map_);
    std::string bytes;
    for (size_t i = 0; i < points.size(); ++i) {
      if (!tiles_.isWithin(tile, points[i].position)) continue;
      bytes.clear();
      appendBytes(points[i].position, bytes);
      format_.append_color(colors_.of(points[i]), bytes);
      if (options_.normals) appendBytes(normals[i], bytes);
      if (has_intensity_) appendBytes(intensityOf(points[i], map_), bytes);
      visit(bytes, points[i].position);
    }
  }

  /** The count is known only once the points are written, so the header is written twice: as long
   * as for the largest count, then in place with the true one. */
  std::string paddedHeader(CloudLayout layout) const {
    const size_t bare = format_.header(layout).size();
    CloudLayout longest = layout;
    longest.points = std::numeric_limits<size_t>::max();
    layout.comments.front().append(format_.header(longest).size() - bare, ' ');
    return format_.header(layout);
  }

 private:
  const ComponentMap& map_;
  const CloudOptions& options_;
  const CloudFormat& format_;
  const bool has_intensity_;
  const PointColors colors_;
  const CloudTiles tiles_;
  std::optional<SolidPoints> solid_;
};

/** How high the points of a file reach. */
struct Written {
  size_t points = 0;
  float low_m = std::numeric_limits<float>::infinity(), high_m = -low_m;
};

/** Writes some tiles into one file. */
Written writeTiles(const Cloud& cloud, const std::vector<const CloudTiles::Tile*>& tiles,
                   const std::string& path) {
  Written written;
  writeBinaryFile(path, [&](std::ostream& file) {
    CloudLayout layout = cloud.layout();
    file << cloud.paddedHeader(layout);
    std::string buffer;
    for (const CloudTiles::Tile* tile : tiles)
      cloud.forEachPointOf(*tile, [&](const std::string& bytes, const Eigen::Vector3f& position) {
        buffer += bytes;
        ++layout.points;
        written.low_m = std::min(written.low_m, position.z());
        written.high_m = std::max(written.high_m, position.z());
        if (buffer.size() < kBufferBytes) return;
        file.write(buffer.data(), static_cast<std::streamsize>(buffer.size()));
        buffer.clear();
      });
    file.write(buffer.data(), static_cast<std::streamsize>(buffer.size()));
    file.seekp(0);
    file << cloud.paddedHeader(layout);
    written.points = layout.points;
  });
  return written;
}

std::vector<std::string> writeOneFile(const Cloud& cloud, const std::string& path) {
  std::vector<const CloudTiles::Tile*> all;
  for (const CloudTiles::Tile& tile : cloud.tiles().tiles()) all.push_back(&tile);
  writeTiles(cloud, all, path);
  return {path};
}

/** Tiles of an earlier state of the map that are no more. */
void removeOthers(const std::string& folder, const std::vector<std::string>& paths) {
  std::vector<fs::path> old;
  for (const auto& entry : fs::directory_iterator(folder))
    if (std::find(paths.begin(), paths.end(), entry.path().string()) == paths.end())
      old.push_back(entry.path());
  for (const fs::path& path : old) fs::remove(path);
}

std::vector<std::string> writeFolder(const Cloud& cloud, const std::string& folder,
                                     const std::string& extension) {
  fs::create_directories(folder);
  std::vector<std::string> paths;
  CsvTable index{{"file", "points", "x_min", "y_min", "z_min", "x_max", "y_max", "z_max"}, {}};
  const double side = cloud.tiles().side();
  for (const CloudTiles::Tile& tile : cloud.tiles().tiles()) {
    const std::string name =
        formatFixed(tile.column, 0) + "_" + formatFixed(tile.row, 0) + "." + extension;
    const Written written = writeTiles(cloud, {&tile}, folder + "/" + name);
    if (written.points == 0) continue;
    paths.push_back(folder + "/" + name);
    std::vector<std::string> row = {name, std::to_string(written.points)};
    for (const double value :
         {tile.column * side, tile.row * side, double{written.low_m}, (tile.column + 1) * side,
          (tile.row + 1) * side, double{written.high_m}})
      row.push_back(formatFixed(value, 3));
    index.rows.push_back(std::move(row));
  }
  paths.push_back(folder + "/index.csv");
  writeTextFile(paths.back(), index.text());
  removeOthers(folder, paths);
  return paths;
}

}  // namespace

std::vector<std::string> writeCloud(const ComponentMap& map, const CloudOptions& options,
                                    const CloudFormat& format, const std::string& stem) {
  checkMap(map);
  const Cloud cloud(map, options, format);
  return options.tile_m > 0 ? writeFolder(cloud, stem + "_" + format.extension, format.extension)
                            : writeOneFile(cloud, stem + "." + format.extension);
}

}  // namespace lamp
