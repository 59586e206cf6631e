#include "lamp/input/RawlogReader.h"

#include <mrpt/maps/registerAllClasses.h>
#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CObservation.h>
#include <mrpt/obs/CObservationComment.h>
#include <mrpt/obs/CSensoryFrame.h>
#include <mrpt/obs/registerAllClasses.h>

#include <stdexcept>

#include "CheckedObject.h"
#include "ObjectHeader.h"
#include "ObjectLayout.h"
#include "RewindableStream.h"

namespace lamp {
namespace {

constexpr size_t kMaxMessages = 10;

/** Linkers drop libraries that are only needed for their initialisers. */
void registerRecordedClasses() {
  static const bool once = [] {
    mrpt::obs::registerAllClasses_mrpt_obs();
    mrpt::maps::registerAllClasses_mrpt_maps();
    return true;
  }();
  (void)once;
}

bool isEntry(const mrpt::serialization::CSerializable& object) {
  const auto* id = object.GetRuntimeClass();
  if (id == CLASS_ID(mrpt::obs::CObservationComment)) return false;
  return id->derivedFrom(CLASS_ID(mrpt::obs::CObservation)) ||
         id->derivedFrom(CLASS_ID(mrpt::obs::CSensoryFrame)) ||
         id->derivedFrom(CLASS_ID(mrpt::obs::CActionCollection));
}

std::string atByte(uint64_t offset) {
  return "byte " + std::to_string(offset) + ": ";
}

}  // namespace

struct RawlogReader::Fault {
  std::string what;
  bool ran_out;  ///< the object needed more bytes than the file has
};

RawlogReader::RawlogReader(const std::string& path) {
  registerRecordedClasses();
  report_.path = path;
  stream_ = std::make_unique<RewindableStream>(path);
  const size_t ready = stream_->prepare(kMaxHeaderBytes);
  if (ready == 0) throw std::runtime_error(path + ": " + stream_->error() + "; copy it anew");
  if (parseObjectHeader(stream_->data(), ready)) return;
  recover(0, {"no object header", false});
  if (finished_) {
    throw std::runtime_error(path +
                             ": not an MRPT rawlog; make one with a tool such as rosbag2rawlog");
  }
}

RawlogReader::~RawlogReader() = default;

double RawlogReader::progress() const {
  return finished_ ? 1.0 : stream_->progress();
}

mrpt::serialization::CSerializable::Ptr RawlogReader::next() {
  while (!finished_) {
    stream_->mark();
    const uint64_t start = stream_->position();
    if (stream_->prepare(1) == 0) {
      finish();
      break;
    }
    const auto object = readObject(start);
    if (object && isEntry(*object)) return object;
  }
  return nullptr;
}

mrpt::serialization::CSerializable::Ptr RawlogReader::readObject(uint64_t start) {
  if (passed_over_ && *stream_->data() == kObjectEndFlag) {
    passed_over_ = false;
    stream_->skip(1);
    return nullptr;
  }
  const size_t ready = stream_->prepare(kMaxHeaderBytes);
  const auto class_name = parseObjectHeader(stream_->data(), ready);
  if (!class_name) {
    recover(start, {"no object header", ready < kMaxHeaderBytes});
    return nullptr;
  }
  if (*class_name != "nullptr" && !mrpt::rtti::findRegisteredClass(*class_name)) {
    ++report_.unknown_classes[*class_name];
    recover(start, {"object of the unknown class " + *class_name, false});
    return nullptr;
  }
  try {
    auto object = readCheckedObject(*stream_);
    ++report_.objects;
    return object;
  } catch (const UnreadClass&) {
    passOver(start);
    return nullptr;
  } catch (const std::exception&) {
    // MRPT's messages are call stacks, and bad_alloc comes of corrupt sizes: both mean damage.
    ++report_.damaged_objects;
    recover(start, {"damaged object of class " + *class_name, stream_->ranOut()});
    return nullptr;
  }
}

void RawlogReader::passOver(uint64_t start) {
  passed_over_ = true;
  stream_->moveTo(start + 1);
  if (!findNextHeader()) finish();
}

void RawlogReader::recover(uint64_t start, const Fault& fault) {
  stream_->moveTo(start + 1);
  const bool found = findNextHeader();
  const uint64_t skipped = stream_->position() - start;
  report_.bytes_skipped += skipped;
  if (!found && fault.ran_out) {
    report_.truncated = true;
    note(atByte(start) + "the file is cut off in the middle of an object; its last " +
         std::to_string(skipped) + " bytes are lost");
  } else {
    note(atByte(start) + fault.what + "; " + std::to_string(skipped) + " bytes skipped");
  }
  if (!found) finish();
}

bool RawlogReader::findNextHeader() {
  bool after_object = false;
  for (size_t ready; (ready = stream_->prepare(kMaxHeaderBytes)) > 0;) {
    // All positions at which a whole header is ready, or the last ones of the file.
    const size_t positions = ready >= kMaxHeaderBytes ? ready - kMaxHeaderBytes + 1 : ready;
    const uint8_t* bytes = stream_->data();
    for (size_t i = 0; i < positions; ++i) {
      if (parseResumableHeader(bytes + i, ready - i, after_object)) {
        stream_->moveTo(stream_->position() + i);
        return true;
      }
      after_object = bytes[i] == kObjectEndFlag;
    }
    stream_->moveTo(stream_->position() + positions);
    stream_->mark();
  }
  return false;
}

void RawlogReader::finish() {
  finished_ = true;
  if (stream_->error().empty()) return;
  report_.truncated = true;
  note(atByte(stream_->position()) + stream_->error() + "; what follows is lost");
}

void RawlogReader::note(const std::string& message) {
  if (report_.messages.size() < kMaxMessages) report_.messages.push_back(message);
}

}  // namespace lamp
