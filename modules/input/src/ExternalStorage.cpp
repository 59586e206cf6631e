#include "ExternalStorage.h"

#include <mrpt/io/lazy_load_path.h>
#include <mrpt/obs/CObservation3DRangeScan.h>
#include <mrpt/obs/CObservationPointCloud.h>

#include <filesystem>

namespace lamp {
namespace {

using mrpt::obs::CObservation3DRangeScan;
using mrpt::obs::CObservationPointCloud;

/** MRPT has one base path for the whole program. */
class LazyLoadFolder {
 public:
  explicit LazyLoadFolder(const std::string& folder) : previous_(mrpt::io::getLazyLoadPathBase()) {
    mrpt::io::setLazyLoadPathBase(folder);
  }
  ~LazyLoadFolder() { mrpt::io::setLazyLoadPathBase(previous_); }
  LazyLoadFolder(const LazyLoadFolder&) = delete;
  LazyLoadFolder& operator=(const LazyLoadFolder&) = delete;

 private:
  const std::string previous_;
};

void loadInto(CObservationPointCloud& cloud) {
  cloud.load();
  cloud.overrideExternalStorageFormatFlag(CObservationPointCloud::ExternalStorageFormat::None);
}

void loadInto(CObservation3DRangeScan& scan) {
  scan.load();
  scan.points3D_overrideExternalStoredFlag(false);
  scan.rangeImage_forceResetExternalStorage();
}

}  // namespace

std::string externalStorageFolder(const std::string& rawlog) {
  const std::filesystem::path path(rawlog);
  const auto folder = path.has_parent_path() ? path.parent_path() : std::filesystem::path(".");
  for (const char* suffix : {"_Images", "_images"}) {
    const auto images = folder / (path.stem().string() + suffix);
    if (std::filesystem::is_directory(images)) return images.string();
  }
  return folder.string();
}

bool loadExternalData(mrpt::obs::CObservation& observation, const std::string& folder) {
  auto* cloud = dynamic_cast<CObservationPointCloud*>(&observation);
  auto* depth = dynamic_cast<CObservation3DRangeScan*>(&observation);
  const bool external =
      (cloud && cloud->isExternallyStored()) ||
      (depth && (depth->points3D_isExternallyStored() || depth->rangeImage_isExternallyStored()));
  if (!external) return true;
  const LazyLoadFolder base(folder);
  try {
    if (cloud) loadInto(*cloud);
    if (depth) loadInto(*depth);
    return true;
  } catch (const std::exception&) {
    return false;
  }
}

}  // namespace lamp
