#include "FuzzTarget.h"
#include "lamp/core/Trajectory.h"

using namespace lamp;

/** A trajectory is not empty, finite, and in the order of distinct stamps. */
extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  const std::string path = fuzz::fileOf(data, size, ".tum");
  fuzz::mayRefuse(path, [&] {
    const std::vector<StampedPose> trajectory = readTum(path);
    fuzz::require(!trajectory.empty(), "not empty");
    for (size_t i = 0; i < trajectory.size(); ++i) {
      fuzz::require(isFinite(trajectory[i].pose), "finite poses");
      fuzz::require(i == 0 || trajectory[i - 1].stamp < trajectory[i].stamp, "stamps grow");
    }
  });
  return 0;
}
