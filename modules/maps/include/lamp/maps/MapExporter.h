#pragma once

#include <memory>
#include <string>
#include <vector>

#include "lamp/core/Geometry.h"
#include "lamp/core/Ids.h"
#include "lamp/core/KeyNodePacket.h"
#include "lamp/core/KeyedScan.h"
#include "lamp/core/PoseGraph.h"
#include "lamp/core/Stage.h"
#include "lamp/maps/Occupancy.h"

namespace lamp {

/** A key node with its keyed scan at its optimised pose, in the frame of the map. */
struct MapKeyNode {
  KeyNodeId id;
  double stamp = 0;
  Pose3 world_T_base = Pose3::Identity();
  KeyedScanPtr scan;
};

/** The optimised trajectory of one robot, one pose a lidar scan. */
struct MapTrack {
  RobotId robot;
  std::vector<StampedPose> poses;
};

/** A loop closure between two key nodes of the map. */
struct MapLoop {
  Eigen::Vector3d from, to;  ///< in the frame of the map, metres
  Verdict verdict = Verdict::kPending;
};

/** Everything that a map of one component is made of. The frame of the map has the axes of the
 * world and an origin near the robots: most map formats have single precision, which is half a
 * metre at the coordinates of a national grid. */
struct ComponentMap {
  /** World coordinates of the map's origin, metres; whole numbers. Exporters write it into their
   * files as data. */
  Eigen::Vector3d world_p_origin = Eigen::Vector3d::Zero();
  std::vector<MapKeyNode> key_nodes;  ///< in KeyNodeId order
  std::vector<MapTrack> tracks;       ///< in RobotId order
  std::vector<MapLoop> loops;
  const RobotTable* robots = nullptr;
  /** Never null; that of a run is one for all of its maps. */
  std::shared_ptr<Occupancy> occupancy = std::make_shared<Occupancy>();
};

/** Turns one component into files. */
class MapExporter : public Stage {
  DEFINE_VIRTUAL_MRPT_OBJECT(MapExporter)

 public:
  /** Writes `<stem>.<extension>` for each of the exporter's formats.
   *  \return the paths written. \throws std::runtime_error naming the path. */
  virtual std::vector<std::string> exportMap(const ComponentMap& map, const std::string& stem) = 0;
};

/** Colour of a robot in maps and pictures, 0..255 each; distinct for the first eight. */
struct Color {
  uint8_t r = 0, g = 0, b = 0;
};
Color robotColor(RobotId robot);

/** Registers MapExporter and all exporters. */
void registerAllClasses_lamp_maps();

}  // namespace lamp
