#include "lamp/core/CloudFile.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <limits>
#include <stdexcept>

#include "PcdFile.h"
#include "lamp/core/Files.h"
#include "lamp/core/PlyVertices.h"

namespace lamp {

namespace {

using Eigen::Vector3d;

/** Nearer to the origin a float is good to a millimetre. */
constexpr double kLarge_m = 1e4;
/** Offsets are round numbers, to be told and typed. */
constexpr double kRoundOffset_m = 100;
/** No lidar sees farther than this. */
constexpr double kFarFromSensor_m = 1e3;

/** Takes the points of a file as doubles, and makes them floats about an offset. */
class PointTaker {
 public:
  void reserve(size_t announced) { points_.reserve(announced); }

  void take(const double* xyz) {
    const Vector3d point = Eigen::Map<const Vector3d>(xyz);
    // A double may be finite and yet too large for a float.
    if (!point.cast<float>().allFinite()) {
      ++cloud_.not_finite;
    } else if (point.isZero(0)) {
      ++cloud_.no_return;
    } else {
      points_.push_back(point);
    }
  }

  /** \param stated the file's own offset. */
  CloudPoints cloud(const Vector3d& viewpoint, const Vector3d& stated) && {
    const Vector3d middle = median();
    if (middle.cwiseAbs().maxCoeff() > kLarge_m) {
      cloud_.offset = (middle / kRoundOffset_m).array().round() * kRoundOffset_m;
      cloud_.rounded_to_m = roundedTo();
    }
    for (const Vector3d& point : points_)
      cloud_.points.push_back((point - cloud_.offset).cast<float>());
    if (cloud_.offset.isZero() || (viewpoint - middle).norm() < kFarFromSensor_m)
      cloud_.viewpoint = viewpoint - cloud_.offset;
    cloud_.offset += stated;
    return std::move(cloud_);
  }

 private:
  /** Along each axis; zero without points. */
  Vector3d median() const {
    Vector3d middle = Vector3d::Zero();
    std::vector<double> values(points_.size());
    for (int axis = 0; axis < 3 && !points_.empty(); ++axis) {
      std::transform(points_.begin(), points_.end(), values.begin(),
                     [axis](const Vector3d& point) { return point[axis]; });
      const auto place = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
      std::nth_element(values.begin(), place, values.end());
      middle[axis] = *place;
    }
    return middle;
  }

  /** The step of floats at the largest coordinate of an axis on which all are floats. */
  double roundedTo() const {
    double step = 0;
    for (int axis = 0; axis < 3; ++axis) {
      const auto is_float = [axis](const Vector3d& point) {
        return static_cast<double>(static_cast<float>(point[axis])) == point[axis];
      };
      if (!std::all_of(points_.begin(), points_.end(), is_float)) continue;
      float largest = 0;
      for (const Vector3d& point : points_)
        largest = std::max(largest, std::abs(static_cast<float>(point[axis])));
      step = std::max<double>(
          step, std::nextafter(largest, std::numeric_limits<float>::infinity()) - largest);
    }
    return step;
  }

  CloudPoints cloud_;
  std::vector<Vector3d> points_;
};

CloudPoints readPly(std::unique_ptr<std::istream> file, const std::string& name) {
  const PlyVertices vertices(std::move(file), name);
  PointTaker taker;
  taker.reserve(vertices.count());
  vertices.read(
      {"x", "y", "z"}, [&](const double* xyz) { taker.take(xyz); }, PlyVertices::NotFinite::kTake);
  return std::move(taker).cloud(Vector3d::Zero(), vertices.offset());
}

CloudPoints readPcd(std::unique_ptr<std::istream> stream, const std::string& name) {
  const PcdFile file(std::move(stream), name);
  PointTaker taker;
  taker.reserve(file.header().points);
  file.readXyz([&](const double* xyz) { taker.take(xyz); });
  return std::move(taker).cloud(file.header().viewpoint, file.header().offset);
}

CloudKind kindOf(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (extension == ".ply") return CloudKind::kPly;
  if (extension == ".pcd") return CloudKind::kPcd;
  throw std::runtime_error("'" + path +
                           "' cannot be read as a cloud: its name must end in .ply or .pcd");
}

}  // namespace

CloudPoints readCloudPoints(const std::string& path) {
  const CloudKind kind = kindOf(path);
  return readCloudPoints(openedToRead(path), kind, path);
}

CloudPoints readCloudPoints(std::unique_ptr<std::istream> file, CloudKind kind,
                            const std::string& name) {
  CloudPoints cloud =
      kind == CloudKind::kPly ? readPly(std::move(file), name) : readPcd(std::move(file), name);
  if (cloud.points.empty())
    throw std::runtime_error("'" + name + "' holds no point" +
                             (cloud.not_finite + cloud.no_return > 0
                                  ? " with finite coordinates other than 0 0 0"
                                  : ""));
  return cloud;
}

}  // namespace lamp
