#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include "TemporaryFolder.h"
#include "lamp/maps/MapExporter.h"

namespace lamp {

using test::freshFolder;

inline std::string bytesOf(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

inline size_t fileCount(const std::string& folder) {
  const std::filesystem::directory_iterator begin(folder), end;
  return static_cast<size_t>(std::distance(begin, end));
}

/** A scan with one sensor. */
inline std::shared_ptr<Scan> makeScan(const std::vector<Eigen::Vector3f>& points,
                                      const Eigen::Vector3d& origin = Eigen::Vector3d::Zero()) {
  auto scan = std::make_shared<Scan>();
  scan->points = points;
  scan->sensor.assign(points.size(), 0);
  scan->sensors = {{"lidar", origin}};
  return scan;
}

/** Two robots and no key node. */
struct TestMap {
  RobotTable robots;
  ComponentMap map;

  TestMap() {
    robots.add("husky1");
    robots.add("spot2");
    map.robots = &robots;
  }
  TestMap(const TestMap&) = delete;

  void add(uint16_t robot, const Pose3& world_T_base, KeyedScanPtr scan) {
    uint32_t index = 0;
    for (const MapKeyNode& key_node : map.key_nodes)
      if (key_node.id.robot == RobotId{robot}) ++index;
    map.key_nodes.push_back({{RobotId{robot}, index}, 1.0 * index, world_T_base, scan});
  }
  void addTrack(uint16_t robot, const std::vector<Eigen::Vector2d>& positions) {
    MapTrack track;
    track.robot = RobotId{robot};
    for (const Eigen::Vector2d& p : positions)
      track.poses.push_back({1.0 * track.poses.size(), planarPose(p.x(), p.y(), 0)});
    map.tracks.push_back(track);
  }
};

/** A message of the error that `action` throws, or an empty text. */
template <class Action>
std::string errorOf(Action&& action) {
  try {
    action();
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "";
}

}  // namespace lamp
