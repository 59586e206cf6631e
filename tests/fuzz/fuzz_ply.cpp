#include "FuzzTarget.h"
#include "lamp/core/CloudFile.h"

using namespace lamp;

/** A cloud has points, and all are finite. */
extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  const std::string path = fuzz::fileOf(data, size, ".ply");
  fuzz::mayRefuse(path, [&] {
    const CloudPoints cloud = readCloudPoints(path);
    fuzz::require(!cloud.points.empty(), "not empty");
    for (const Eigen::Vector3f& point : cloud.points)
      fuzz::require(point.allFinite(), "finite points");
  });
  return 0;
}
