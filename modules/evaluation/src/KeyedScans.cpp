#include "lamp/evaluation/KeyedScans.h"

#include <mrpt/core/Clock.h>
#include <mrpt/io/CFileGZInputStream.h>
#include <mrpt/obs/CObservationPointCloud.h>
#include <mrpt/serialization/CArchive.h>

#include <stdexcept>

#include "lamp/evaluation/Truth.h"

namespace lamp::evaluation {

namespace {

void append(const mrpt::obs::CObservationPointCloud& cloud, std::vector<Eigen::Vector3f>& points) {
  if (!cloud.pointcloud) return;
  const auto matrix =
      cloud.sensorPose.getHomogeneousMatrixVal<mrpt::math::CMatrixDouble44>().asEigen().eval();
  const Eigen::Isometry3f base_T_sensor(matrix.cast<float>());
  for (size_t i = 0; i < cloud.pointcloud->size(); ++i) {
    Eigen::Vector3f p;
    cloud.pointcloud->getPoint(i, p.x(), p.y(), p.z());
    points.push_back(base_T_sensor * p);
  }
}

}  // namespace

const std::vector<Eigen::Vector3f>* KeyedScans::at(double stamp) const {
  const auto found = by_stamp.lower_bound(stamp - TrueTrajectory::kSameStamp);
  if (found == by_stamp.end() || found->first > stamp + TrueTrajectory::kSameStamp) return nullptr;
  return &found->second;
}

KeyedScans readKeyedScans(const std::string& path) {
  mrpt::io::CFileGZInputStream file;
  if (!file.open(path)) throw std::runtime_error("cannot read '" + path + "'");
  auto archive = mrpt::serialization::archiveFrom(file);
  KeyedScans scans;
  try {
    while (true) {
      const auto object = archive.ReadObject<mrpt::serialization::CSerializable>();
      const auto cloud = std::dynamic_pointer_cast<mrpt::obs::CObservationPointCloud>(object);
      if (cloud) append(*cloud, scans.by_stamp[mrpt::Clock::toDouble(cloud->timestamp)]);
    }
  } catch (const mrpt::serialization::CExceptionEOF&) {
    return scans;
  } catch (const std::exception& error) {
    scans.damage = "'" + path + "' is damaged after " + std::to_string(scans.by_stamp.size()) +
                   " keyed scans: " + std::string(error.what()).substr(0, 200);
  }
  return scans;
}

}  // namespace lamp::evaluation
