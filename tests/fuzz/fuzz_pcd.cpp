#include <memory>
#include <sstream>

#include "FuzzTarget.h"
#include "lamp/core/CloudFile.h"

using namespace lamp;

/** A cloud has points, and all are finite. */
extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  fuzz::mayRefuse("fuzz.pcd", [&] {
    auto file = std::make_unique<std::istringstream>(fuzz::textOf(data, size));
    const CloudPoints cloud = readCloudPoints(std::move(file), CloudKind::kPcd, "fuzz.pcd");
    fuzz::require(!cloud.points.empty(), "not empty");
    fuzz::require(cloud.offset.allFinite(), "a finite offset");
    for (const Eigen::Vector3f& point : cloud.points)
      fuzz::require(point.allFinite(), "finite points");
  });
  return 0;
}
