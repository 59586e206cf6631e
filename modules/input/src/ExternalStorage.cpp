#include "ExternalStorage.h"

#include <mrpt/io/lazy_load_path.h>
#include <mrpt/obs/CObservation3DRangeScan.h>
#include <mrpt/obs/CObservationPointCloud.h>

#include <filesystem>

#include "LayoutCursor.h"
#include "ObjectHeader.h"
#include "RewindableStream.h"

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

bool isText(const std::string& file) {
  const std::string extension = std::filesystem::path(file).extension();
  return extension == ".txt" || extension == ".TXT";
}

bool beginsWithObject(const std::string& file) {
  RewindableStream stream(file);
  const size_t ready = stream.prepare(kMaxHeaderBytes);
  return parseObjectHeader(stream.data(), ready).has_value();
}

/** MRPT trusts the sizes in such a file, too. */
template <class Follow>
void check(const std::string& file, const Follow& follow) {
  RewindableStream stream(file);
  LayoutCursor cursor(stream);
  follow(cursor);
}

void checkCloud(const std::string& file) {
  using namespace classes;
  if (!beginsWithObject(file)) return;
  check(file, [](LayoutCursor& in) {
    in.optionalPart({kSimplePoints, kPointsXYZI, kColouredPoints, kWeightedPoints});
  });
}
void checkPoints(const std::string& file) {
  if (!isText(file)) check(file, [](LayoutCursor& in) { in.coordinates(); });
}
void checkRangeImage(const std::string& file) {
  if (isText(file)) return;
  if (beginsWithObject(file))
    return check(file, [](LayoutCursor& in) { in.part({classes::kMatrixF}); });
  check(file, [](LayoutCursor& in) {
    const uint32_t rows = in.number();
    in.grid(rows, in.number(), sizeof(uint16_t));
  });
}
void checkFiles(const CObservation3DRangeScan& scan) {
  if (scan.hasPoints3D && scan.points3D_isExternallyStored())
    checkPoints(scan.points3D_getExternalStorageFileAbsolutePath());
  if (!scan.hasRangeImage || !scan.rangeImage_isExternallyStored()) return;
  checkRangeImage(scan.rangeImage_getExternalStorageFileAbsolutePath(""));
  for (const auto& layer : scan.rangeImageOtherLayers)
    checkRangeImage(scan.rangeImage_getExternalStorageFileAbsolutePath(layer.first));
}

void loadInto(CObservationPointCloud& cloud) {
  checkCloud(mrpt::io::lazy_load_absolute_path(cloud.getExternalStorageFile()));
  cloud.load();
  cloud.overrideExternalStorageFormatFlag(CObservationPointCloud::ExternalStorageFormat::None);
}

void loadInto(CObservation3DRangeScan& scan) {
  checkFiles(scan);
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
