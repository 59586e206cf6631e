#include "lamp/maps/MapExporter.h"
#include "lamp/maps/OctoMap.h"
#include "lamp/maps/Pcd.h"
#include "lamp/maps/Picture.h"
#include "lamp/maps/Ply.h"

namespace lamp {

void registerAllClasses_lamp_maps() {
  mrpt::rtti::registerClass(CLASS_ID(MapExporter));
  mrpt::rtti::registerClass(CLASS_ID(Ply));
  mrpt::rtti::registerClass(CLASS_ID(Pcd));
  mrpt::rtti::registerClass(CLASS_ID(OctoMap));
  mrpt::rtti::registerClass(CLASS_ID(Picture));
}

}  // namespace lamp
