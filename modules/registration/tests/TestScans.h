#pragma once

#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "../../scans/tests/TestRooms.h"
#include "StageSuite.h"
#include "lamp/registration/LoopClosureComputation.h"
#include "lamp/scans/PreparedScan.h"

namespace lamp::test {

using Points = std::vector<Eigen::Vector3f>;

constexpr double kDegree = M_PI / 180.0;

inline Vector6d tangent(double x, double y, double z, double rx, double ry, double rz) {
  Vector6d v;
  v << x, y, z, rx, ry, rz;
  return v;
}

inline Points moved(Points points, const Pose3& T) {
  const Eigen::Isometry3f Tf = T.cast<float>();
  for (auto& p : points) p = Tf * p;
  return points;
}

/** Two independent samples of one room, the second one seen from another pose. */
struct RoomPair {
  RoomPair(const Pose3& target_T_source, bool planar)
      : truth(target_T_source),
        target(planar ? prepareScan(planarRoomPoints(720, 0.01f, 1), 6, true)
                      : prepareScan(roomPoints(3000, 0.01f, 1), 10, false)),
        source(planar
                   ? prepareScan(moved(planarRoomPoints(360, 0.01f, 2), truth.inverse()), 6, true)
                   : prepareScan(moved(roomPoints(1500, 0.01f, 2), truth.inverse()), 10, false)) {}

  Pose3 truth;
  PreparedScanPtr target, source;
};

/** Names of the stages of one kind that are registered, of plugins that tests load, too. */
inline std::vector<std::string> registered(const mrpt::rtti::TRuntimeClassId* base) {
  registerAllClasses_lamp_core();
  registerAllClasses_lamp_registration();
  return stageClasses(base);
}

struct NamedPoints {
  std::string name;
  Points points;
};

/** Clouds that cannot be registered with a room around the origin. */
inline std::vector<NamedPoints> hopelessClouds() {
  return {{"no points", {}},
          {"one point", {{1, 0, 0}}},
          {"three points", {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}},
          {"equal points", Points(50, Eigen::Vector3f(1, 1, 1))},
          {"far away", moved(roomPoints(300, 0.01f, 5), expSE3(tangent(500, 300, 0, 0, 0, 0)))}};
}

}  // namespace lamp::test
