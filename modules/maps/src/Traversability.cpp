#include "lamp/maps/Traversability.h"

#include "GroundSurface.h"
#include "OccupiedSpace.h"
#include "lamp/core/CloudHeader.h"
#include "lamp/core/Files.h"

IMPLEMENTS_MRPT_OBJECT(Traversability, lamp::MapExporter, lamp)

namespace lamp {

namespace {

const std::vector<CloudField> kFields = {{"x"},     {"y"},         {"z"},    {"step"},
                                         {"slope"}, {"clearance"}, {"cost"}, {"storey"}};

void append(const GroundPoint& point, size_t storey, std::string& bytes) {
  appendBytes(Eigen::Vector3f(point.position.cast<float>()), bytes);
  for (const double value :
       {point.step_m, point.slope_deg, point.clearance_m, point.cost, static_cast<double>(storey)})
    appendBytes(static_cast<float>(value), bytes);
}

}  // namespace

std::vector<std::string> Traversability::exportMap(const ComponentMap& map,
                                                   const std::string& stem) {
  const std::vector<Storey>& storeys = map.occupancy->of(map).storeys();
  const auto ground = groundOf(storeys, map, map.occupancy->options());
  CloudLayout layout{{".PCD v0.7 - Point Cloud Data file format"}, kFields, 0};
  if (const std::string offset = offsetComment(map.world_p_origin); !offset.empty())
    layout.comments.push_back(offset);
  std::string bytes;
  for (size_t storey = 0; storey < ground.size(); ++storey)
    for (const GroundPoint& point : ground[storey]) {
      append(point, storey, bytes);
      ++layout.points;
    }
  const std::string path = stem + ".ground.pcd";
  writeTextFile(path, pcdHeader(layout) + bytes);
  return {path};
}

}  // namespace lamp
