#include "CheckedObject.h"

#include <mrpt/img/CImage.h>
#include <mrpt/io/CMemoryStream.h>
#include <mrpt/obs/CObservation.h>
#include <mrpt/rtti/CObject.h>
#include <mrpt/serialization/CArchive.h>

#include <string>
#include <string_view>

#include "ClassLayouts.h"
#include "ObjectHeader.h"
#include "ObjectLayout.h"
#include "RewindableStream.h"

namespace lamp {
namespace {

using mrpt::io::CMemoryStream;
using mrpt::serialization::archiveFrom;
using mrpt::serialization::CSerializable;

/** Whether an observation follows whose class a plugin has brought. */
bool isOfPlugin(RewindableStream& stream) {
  const size_t ready = stream.prepare(kMaxHeaderBytes);
  const auto name = parseObjectHeader(stream.data(), ready);
  const auto* id = name ? mrpt::rtti::findRegisteredClass(*name) : nullptr;
  if (!id || !id->derivedFrom(CLASS_ID(mrpt::obs::CObservation))) return false;
  const std::string_view full_name = id->className;
  return full_name.substr(0, 6) != "mrpt::" && recordedLayouts().count(full_name) == 0;
}

std::string emptyPicture() {
  mrpt::img::CImage picture;
  picture.setExternalStorage("");
  CMemoryStream memory;
  archiveFrom(memory) << picture;
  return {static_cast<const char*>(memory.getRawBufferData()), memory.getTotalBytesCount()};
}

std::string withoutPictures(const RewindableStream& stream, uint64_t start,
                            const ObjectLayout& layout) {
  static const std::string empty = emptyPicture();
  std::string bytes;
  const auto append = [&](uint64_t begin, uint64_t end) {
    bytes.append(reinterpret_cast<const char*>(stream.dataAt(begin)), end - begin);
  };
  for (const ByteRange& picture : layout.pictures) {
    append(start, picture.begin);
    bytes += empty;
    start = picture.end;
  }
  append(start, layout.end);
  return bytes;
}

CSerializable::Ptr readFrom(const void* bytes, uint64_t size) {
  CMemoryStream memory;
  memory.assignMemoryNotOwn(bytes, size);
  return archiveFrom(memory).ReadObject();
}

}  // namespace

CSerializable::Ptr readCheckedObject(RewindableStream& stream) {
  if (isOfPlugin(stream)) return archiveFrom(stream).ReadObject();
  const uint64_t start = stream.position();
  const ObjectLayout layout = layoutOf(stream);
  if (layout.pictures.empty()) return readFrom(stream.dataAt(start), layout.end - start);
  const std::string bytes = withoutPictures(stream, start, layout);
  return readFrom(bytes.data(), bytes.size());
}

}  // namespace lamp
