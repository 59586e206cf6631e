#pragma once

#include <string>
#include <vector>

#include "lamp/core/CloudHeader.h"
#include "lamp/maps/CloudOptions.h"
#include "lamp/maps/MapExporter.h"

namespace lamp {

/** What differs between the kinds of cloud files. */
struct CloudFormat {
  std::string extension;  ///< without a dot
  std::string (*header)(const CloudLayout&);
  std::string first_comment;
  std::vector<CloudField> color_fields;
  void (*append_color)(Color color, std::string& bytes);
  std::vector<CloudField> normal_fields;
};

/** Writes the map's points as `<stem>.<extension>`, or in tiles as files of a folder
 * `<stem>_<extension>` with an index (docs/maps.md). After x, y, z and the colour come the normal,
 * if asked for, and the intensity, if a scan has any. Piece by piece: memory does not grow with the
 * map. \return the paths. \throws std::runtime_error naming the path. */
std::vector<std::string> writeCloud(const ComponentMap& map, const CloudOptions& options,
                                    const CloudFormat& format, const std::string& stem);

}  // namespace lamp
