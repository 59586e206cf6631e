#include "lamp/maps/MapExporter.h"

#include <array>

IMPLEMENTS_VIRTUAL_MRPT_OBJECT(MapExporter, Stage, lamp)

namespace lamp {

Color robotColor(RobotId robot) {
  constexpr std::array<Color, 8> kColors = {{{31, 119, 180},
                                             {255, 127, 14},
                                             {44, 160, 44},
                                             {148, 103, 189},
                                             {140, 86, 75},
                                             {227, 119, 194},
                                             {23, 190, 207},
                                             {188, 189, 34}}};
  return kColors[robot.value % kColors.size()];
}

}  // namespace lamp
