#pragma once

#include <mrpt/serialization/CSerializable.h>

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace lamp {

class RewindableStream;

/** What was read of one file, and what was lost. */
struct RawlogReport {
  std::string path;
  size_t objects = 0;          ///< read and used
  size_t damaged_objects = 0;  ///< known classes that could not be read
  uint64_t bytes_skipped = 0;  ///< of the uncompressed data, over damaged and unknown objects
  bool truncated = false;      ///< the file ends too early, or cannot be decompressed to its end
  std::map<std::string, size_t> unknown_classes;  ///< class name, number of objects
  /** What happened where, in file order; the first few only. */
  std::vector<std::string> messages;
};

/** Streams the objects of one rawlog, gzipped or plain.
 *
 * Loses only what is damaged: after an object that cannot be read, or whose class is unknown, it
 * goes on at the next object header (class name length with the top bit set, then the name of a
 * registered class that may stand in a rawlog). Observations within a damaged sensory frame are
 * saved one by one. MRPT's own reader stops silently in these cases.
 *
 * What MRPT would read is checked first, since its deserialisers trust sizes and class names.
 * MRPT's classes that we have no use for are passed over, but what else a sensory frame holds is
 * read; pictures are not decoded. Classes of plugins check for themselves what they read.
 */
class RawlogReader {
 public:
  /** \throws std::runtime_error naming the file if it is missing, empty, or not an MRPT rawlog. */
  explicit RawlogReader(const std::string& path);
  ~RawlogReader();

  /** The next CObservation, CSensoryFrame, or CActionCollection; null at the end. Objects of other
   * known classes, such as the recording's comment, are passed over. */
  mrpt::serialization::CSerializable::Ptr next();

  /** Share of the file that has been read, 0 to 1. */
  double progress() const;
  const RawlogReport& report() const { return report_; }

 private:
  struct Fault;
  mrpt::serialization::CSerializable::Ptr readObject(uint64_t start);
  bool findNextHeader();
  /** Goes on behind the header of an object that is not read itself. */
  void passOver(uint64_t start);
  void recover(uint64_t start, const Fault& fault);
  void finish();
  void note(const std::string& message);

  std::unique_ptr<RewindableStream> stream_;
  RawlogReport report_;
  bool passed_over_ = false;  ///< an object, of which an end flag may be left
  bool finished_ = false;
};

}  // namespace lamp
