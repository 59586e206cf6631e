#include "lamp/core/CloudFile.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <stdexcept>

#include "PcdFile.h"
#include "lamp/core/PlyVertices.h"

namespace lamp {

namespace {

/** Keeps the points that are somewhere. */
class PointTaker {
 public:
  PointTaker(CloudPoints& cloud, size_t announced) : cloud_(cloud) {
    cloud_.points.reserve(announced);
  }
  void operator()(const double* xyz) const {
    // A double may be finite and yet too large for a float.
    const Eigen::Vector3f point = Eigen::Map<const Eigen::Vector3d>(xyz).cast<float>();
    if (point.allFinite())
      cloud_.points.push_back(point);
    else
      ++cloud_.not_finite;
  }

 private:
  CloudPoints& cloud_;
};

CloudPoints readPly(const std::string& path) {
  CloudPoints cloud;
  const PlyVertices file(path);
  file.read({"x", "y", "z"}, PointTaker(cloud, file.count()), PlyVertices::NotFinite::kTake);
  return cloud;
}

CloudPoints readPcd(const std::string& path) {
  CloudPoints cloud;
  const PcdFile file(path);
  cloud.viewpoint = file.header().viewpoint;
  file.readXyz(PointTaker(cloud, file.header().points));
  return cloud;
}

std::string extensionOf(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

}  // namespace

CloudPoints readCloudPoints(const std::string& path) {
  const std::string extension = extensionOf(path);
  if (extension != ".ply" && extension != ".pcd")
    throw std::runtime_error("'" + path +
                             "' is no cloud that can be read: it must end in .ply or .pcd");
  CloudPoints cloud = extension == ".ply" ? readPly(path) : readPcd(path);
  if (cloud.points.empty())
    throw std::runtime_error("'" + path + "' holds no point" +
                             (cloud.not_finite > 0 ? " with finite coordinates" : ""));
  return cloud;
}

}  // namespace lamp
