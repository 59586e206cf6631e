#include "ObjectHeader.h"

#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CObservation.h>
#include <mrpt/obs/CSensoryFrame.h>

#include <algorithm>

namespace lamp {
namespace {

constexpr size_t kMaxNameLength = 120;
constexpr uint8_t kNewFormatBit = 0x80;

// By hand, since the locale must not matter.
bool isLetter(uint8_t c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}
bool isNameCharacter(uint8_t c) {
  return isLetter(c) || (c >= '0' && c <= '9') || c == ':';
}

std::optional<std::string> parseName(const uint8_t* bytes, size_t count, size_t length) {
  if (length == 0 || length > kMaxNameLength || length > count) return {};
  if (!isLetter(bytes[0]) || !std::all_of(bytes, bytes + length, isNameCharacter)) return {};
  return std::string(bytes, bytes + length);
}

bool standsInRawlogs(const mrpt::rtti::TRuntimeClassId* id) {
  return id->derivedFrom(CLASS_ID(mrpt::obs::CObservation)) ||
         id->derivedFrom(CLASS_ID(mrpt::obs::CSensoryFrame)) ||
         id->derivedFrom(CLASS_ID(mrpt::obs::CActionCollection));
}

bool looksLikeClassName(const std::string& name) {
  const size_t separator = name.find("::");
  return separator != std::string::npos && separator > 0 && separator + 2 < name.size();
}

}  // namespace

std::optional<std::string> parseObjectHeader(const uint8_t* bytes, size_t count) {
  if (count < 1) return {};
  if (bytes[0] & kNewFormatBit) return parseName(bytes + 1, count - 1, bytes[0] & ~kNewFormatBit);
  const bool old_format = count >= 4 && bytes[1] == 0 && bytes[2] == 0 && bytes[3] == 0;
  if (!old_format) return {};
  return parseName(bytes + 4, count - 4, bytes[0]);
}

std::optional<std::string> parseResumableHeader(const uint8_t* bytes, size_t count,
                                                bool after_object) {
  if (count < 1 || !(bytes[0] & kNewFormatBit)) return {};
  auto name = parseObjectHeader(bytes, count);
  if (!name) return {};
  if (const auto* id = mrpt::rtti::findRegisteredClass(*name)) {
    if (!standsInRawlogs(id)) return {};
    return name;
  }
  if (!after_object || !looksLikeClassName(*name)) return {};
  return name;
}

}  // namespace lamp
