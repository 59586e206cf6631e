#include "lamp/maps/SimpleMap.h"

#include <mrpt/maps/CSimpleMap.h>
#include <mrpt/poses/CPose3DPDFGaussian.h>

#include "MapPoints.h"
#include "lamp/core/MrptFile.h"
#include "lamp/core/ScanObservation.h"

IMPLEMENTS_MRPT_OBJECT(SimpleMap, lamp::MapExporter, lamp)

namespace lamp {

namespace {

mrpt::poses::CPose3DPDFGaussian::Ptr poseOf(const MapKeyNode& key_node) {
  auto pose = mrpt::poses::CPose3DPDFGaussian::Create();
  pose->mean = mrpt::poses::CPose3D(mrpt::math::CMatrixDouble44(key_node.world_T_base.matrix()));
  pose->cov.setZero();
  return pose;
}

/** The points that are finite. */
Scan cleaned(const Scan& scan) {
  Scan clean;
  clean.sensors = scan.sensors;
  for (size_t i = 0; i < scan.size(); ++i) {
    if (!scan.points[i].allFinite()) continue;
    clean.points.push_back(scan.points[i]);
    clean.sensor.push_back(scan.sensor[i]);
    if (scan.hasIntensity()) clean.intensity.push_back(scan.intensity[i]);
  }
  return clean;
}

mrpt::obs::CSensoryFrame::Ptr frameOf(const MapKeyNode& key_node, const std::string& robot) {
  auto frame = mrpt::obs::CSensoryFrame::Create();
  if (!key_node.scan) return frame;
  const Scan scan = cleaned(*key_node.scan);
  for (size_t sensor = 0; sensor < scan.sensors.size(); ++sensor)
    frame->insert(std::make_shared<mrpt::obs::CObservationPointCloud>(
        scanObservation(scan, sensor, robot, key_node.stamp)));
  return frame;
}

}  // namespace

std::vector<std::string> SimpleMap::exportMap(const ComponentMap& map, const std::string& stem) {
  checkMap(map);
  mrpt::maps::CSimpleMap simple_map;
  for (const MapKeyNode& key_node : map.key_nodes)
    simple_map.insert(mrpt::poses::CPose3DPDF::Ptr(poseOf(key_node)),
                      frameOf(key_node, robotName(map, key_node.id.robot)));
  const std::string path = stem + ".simplemap";
  writeMrptFile(path, [&](const MrptSink& sink) { sink(simple_map); });
  return {path};
}

}  // namespace lamp
