#pragma once

#include <mrpt/core/Clock.h>
#include <mrpt/io/CFileGZOutputStream.h>
#include <mrpt/maps/CSimplePointsMap.h>
#include <mrpt/obs/CObservationPointCloud.h>
#include <mrpt/serialization/CArchive.h>

#include <Eigen/Core>
#include <map>
#include <string>
#include <vector>

namespace lamp::test {

/** One keyed scan after the other, in a sensor frame 0.5 m above the base. */
inline void writeKeyedScans(const std::string& path,
                            const std::map<double, std::vector<Eigen::Vector3f>>& scans) {
  mrpt::io::CFileGZOutputStream file(path);
  auto archive = mrpt::serialization::archiveFrom(file);
  for (const auto& [stamp, points] : scans) {
    mrpt::obs::CObservationPointCloud cloud;
    cloud.timestamp = mrpt::Clock::fromDouble(stamp);
    cloud.sensorPose = mrpt::poses::CPose3D::FromTranslation(0, 0, 0.5);
    const auto map = mrpt::maps::CSimplePointsMap::Create();
    for (const auto& p : points) map->insertPoint(p.x(), p.y(), p.z() - 0.5f);
    cloud.pointcloud = map;
    archive << cloud;
  }
}

}  // namespace lamp::test
