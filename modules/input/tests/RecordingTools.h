#pragma once

#include <gtest/gtest.h>
#include <mrpt/io/CFileGZOutputStream.h>
#include <mrpt/io/CFileOutputStream.h>
#include <mrpt/io/CMemoryStream.h>
#include <mrpt/maps/CPointsMapXYZI.h>
#include <mrpt/maps/CSimplePointsMap.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/CObservationPointCloud.h>
#include <mrpt/obs/CObservationRobotPose.h>
#include <mrpt/serialization/CArchive.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "TemporaryFolder.h"

namespace lamp::test {

using Objects = std::vector<mrpt::serialization::CSerializable::Ptr>;

inline std::string bytesOf(const mrpt::serialization::CSerializable& object) {
  mrpt::io::CMemoryStream memory;
  mrpt::serialization::archiveFrom(memory) << object;
  const auto* data = static_cast<const char*>(memory.getRawBufferData());
  return std::string(data, data + memory.getTotalBytesCount());
}

inline std::string bytesOf(const Objects& objects) {
  std::string bytes;
  for (const auto& object : objects) bytes += bytesOf(*object);
  return bytes;
}

/** An object as MRPT would write one of a class that is not linked here. */
inline std::string foreignObject(const std::string& class_name, const std::string& payload) {
  return static_cast<char>(0x80 | class_name.size()) + class_name + '\0' + payload + '\x88';
}

inline void writeFile(const std::string& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
}

inline std::string readFile(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

inline void writeGzFile(const std::string& path, const std::string& bytes) {
  mrpt::io::CFileGZOutputStream file(path);
  file.Write(bytes.data(), bytes.size());
}

inline mrpt::obs::CObservationOdometry::Ptr wheels(double stamp, const std::string& label,
                                                   double x = 0) {
  auto o = mrpt::obs::CObservationOdometry::Create();
  o->timestamp = mrpt::Clock::fromDouble(stamp);
  o->sensorLabel = label;
  o->odometry = mrpt::poses::CPose2D(x, 0, 0);
  return o;
}

/** Cloud of `points` points on a line. */
inline mrpt::obs::CObservationPointCloud::Ptr cloud(double stamp, const std::string& label,
                                                    size_t points = 100) {
  auto o = mrpt::obs::CObservationPointCloud::Create();
  o->timestamp = mrpt::Clock::fromDouble(stamp);
  o->sensorLabel = label;
  auto map = mrpt::maps::CSimplePointsMap::Create();
  for (size_t i = 0; i < points; ++i) map->insertPoint(1.0f + 0.01f * static_cast<float>(i), 2, 3);
  o->pointcloud = map;
  return o;
}

/** The folder of recordings by others, or empty. */
inline std::string dataFolder() {
  const char* given = std::getenv("LAMP_DATA");
  const std::string folder = given ? given : LAMP_SOURCE_DIR "/../shared/data";
  return std::filesystem::is_directory(folder) ? folder : "";
}

/** A recording of MRPT's own, or empty. */
inline std::string mrptRecording(const std::string& name) {
  const std::string path = "/usr/share/mrpt/datasets/" + name;
  return std::filesystem::exists(path) ? path : "";
}

}  // namespace lamp::test
