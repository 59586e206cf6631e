#include "lamp/maps/MapExporter.h"
#include "lamp/maps/OccupancyGrid.h"
#include "lamp/maps/OctoMap.h"
#include "lamp/maps/Pcd.h"
#include "lamp/maps/Picture.h"
#include "lamp/maps/Ply.h"
#include "lamp/maps/Scene3d.h"
#include "lamp/maps/SimpleMap.h"
#include "lamp/maps/Traversability.h"

namespace lamp {

void registerAllClasses_lamp_maps() {
  mrpt::rtti::registerClass(CLASS_ID(MapExporter));
  mrpt::rtti::registerClass(CLASS_ID(Ply));
  mrpt::rtti::registerClass(CLASS_ID(Pcd));
  mrpt::rtti::registerClass(CLASS_ID(OctoMap));
  mrpt::rtti::registerClass(CLASS_ID(OccupancyGrid));
  mrpt::rtti::registerClass(CLASS_ID(Traversability));
  mrpt::rtti::registerClass(CLASS_ID(Picture));
  mrpt::rtti::registerClass(CLASS_ID(SimpleMap));
  mrpt::rtti::registerClass(CLASS_ID(Scene3d));
}

}  // namespace lamp
