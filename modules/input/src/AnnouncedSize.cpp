#include "AnnouncedSize.h"

#include <algorithm>

#include "ObjectHeader.h"

namespace lamp {
namespace {

bool endsWith(std::string_view text, std::string_view end) {
  return text.size() >= end.size() && text.substr(text.size() - end.size()) == end;
}

uint64_t numberAt(std::string_view bytes, size_t offset) {
  if (bytes.size() < offset + 4) return 0;
  uint64_t number = 0;
  for (size_t i = 0; i < 4; ++i) {
    number |= uint64_t{static_cast<uint8_t>(bytes[offset + i])} << (8 * i);
  }
  return number;
}

bool isCloud(std::string_view name) {
  return endsWith(name, "PointsMap") || endsWith(name, "CPointsMapXYZI");
}

bool isMatrix(std::string_view name) {
  return endsWith(name, "CMatrixD") || endsWith(name, "CMatrixF") || endsWith(name, "CMatrix");
}

/** The number of rays comes right after the sensor pose, the only object within a laser scan's
 * first bytes. */
bool isAfterPoseOfLaser(std::string_view object) {
  constexpr size_t kFarthest = 512;
  if (object.empty() || static_cast<uint8_t>(object.back()) != kObjectEndFlag) return false;
  const auto near = object.substr(object.size() - std::min(object.size(), kFarthest));
  const size_t name = near.rfind("CObservation2DRangeScan");
  return name != std::string_view::npos && near.find("CPose3D", name) != std::string_view::npos;
}

}  // namespace

uint64_t announcedSize(std::string_view object, std::string_view ahead) {
  const uint64_t number = numberAt(ahead, 0);
  if (isAfterPoseOfLaser(object)) return number * (sizeof(float) + 1);
  if (object.empty()) return 0;
  const auto before_version = object.substr(0, object.size() - 1);
  if (isCloud(before_version)) return number * 3 * sizeof(float);
  if (isMatrix(before_version)) {
    const uint64_t columns = numberAt(ahead, 4);
    if (number > UINT32_MAX / sizeof(float) || columns > UINT32_MAX / sizeof(float)) {
      return UINT64_MAX;
    }
    return number * columns * sizeof(float);
  }
  return 0;
}

}  // namespace lamp
