#include "lamp/maps/Scene3d.h"

#include <mrpt/opengl/COpenGLScene.h>
#include <mrpt/opengl/CPointCloud.h>
#include <mrpt/opengl/CSetOfLines.h>
#include <mrpt/opengl/CText.h>
#include <mrpt/opengl/stock_objects.h>

#include "MapPoints.h"
#include "lamp/core/CloudHeader.h"
#include "lamp/core/MrptFile.h"
#include "lamp/core/VoxelSet.h"

IMPLEMENTS_MRPT_OBJECT(Scene3d, lamp::MapExporter, lamp)

namespace lamp {

namespace {

using namespace mrpt::opengl;

CPointCloud::Ptr pointsOf(const ComponentMap& map, double voxel_m) {
  auto cloud = CPointCloud::Create();
  cloud->setName("points");
  cloud->setPointSize(2.0f);
  cloud->enableColorFromZ();
  VoxelSet voxels(voxel_m);
  forEachPoint(map, [&](const MapKeyNode&, size_t, const Eigen::Vector3d& position) {
    const Eigen::Vector3f p = position.cast<float>();
    if (voxels.insert(position)) cloud->insertPoint(p.x(), p.y(), p.z());
  });
  return cloud;
}

void appendLine(const Eigen::Vector3d& from, const Eigen::Vector3d& to, CSetOfLines& lines) {
  lines.appendLine(from.x(), from.y(), from.z(), to.x(), to.y(), to.z());
}

void insertTrack(const MapTrack& track, const std::string& name, COpenGLScene& scene) {
  if (track.poses.empty()) return;
  const Color color = robotColor(track.robot);
  auto way = CSetOfLines::Create();
  way->setName("way of " + name);
  way->setLineWidth(3.0f);
  way->setColor_u8(color.r, color.g, color.b);
  for (size_t i = 1; i < track.poses.size(); ++i)
    appendLine(track.poses[i - 1].pose.translation(), track.poses[i].pose.translation(), *way);
  scene.insert(way);

  const Eigen::Vector3d start = track.poses.front().pose.translation();
  auto corner = stock_objects::CornerXYZ(1.0f);
  corner->setLocation(start.x(), start.y(), start.z());
  corner->setName("start of " + name);
  scene.insert(corner);
  auto label = CText::Create(name);
  label->setLocation(start.x(), start.y(), start.z() + 1.0);
  label->setColor_u8(color.r, color.g, color.b);
  scene.insert(label);
}

CSetOfLines::Ptr acceptedLoops(const ComponentMap& map) {
  auto lines = CSetOfLines::Create();
  lines->setName("loop closures");
  lines->setColor_u8(0, 160, 0);
  for (const MapLoop& loop : map.loops)
    if (loop.verdict == Verdict::kInlier) appendLine(loop.from, loop.to, *lines);
  return lines;
}

}  // namespace

std::vector<std::string> Scene3d::exportMap(const ComponentMap& map, const std::string& stem) {
  checkMap(map);
  COpenGLScene scene;
  scene.insert(pointsOf(map, options_.voxel_m));
  for (const MapTrack& track : map.tracks) insertTrack(track, robotName(map, track.robot), scene);
  scene.insert(acceptedLoops(map));
  if (const std::string offset = offsetComment(map.world_p_origin); !offset.empty())
    scene.insert(CText::Create(offset));
  const std::string path = stem + ".3Dscene";
  writeMrptFile(path, [&](const MrptSink& sink) { sink(scene); });
  return {path};
}

}  // namespace lamp
