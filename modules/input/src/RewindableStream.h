#pragma once

#include <mrpt/io/CStream.h>
#include <zlib.h>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace lamp {

/** Reads a file, gzipped or plain, keeping what came after a mark, so that one can go back there.
 * Offsets count uncompressed bytes. */
class RewindableStream : public mrpt::io::CStream {
 public:
  /** Corrupt sizes must not make us swallow the rest of a large file. */
  static constexpr size_t kMaxKeptBytes = size_t{256} << 20;

  /** \throws std::runtime_error naming the file. */
  explicit RewindableStream(const std::string& path);

  /** Makes at least `count` bytes ready at the position, unless the data end before.
   *  \return the bytes that are ready. */
  size_t prepare(size_t count);
  /** Valid until the next call that is not const. */
  const uint8_t* data() const { return buffer_.data() + cursor_; }

  uint64_t position() const { return buffer_start_ + cursor_; }
  /** Makes `count` bytes ready.
   *  \return the bytes. \throws std::runtime_error if there are not so many, or more than
   *  `kMaxKeptBytes` since the last mark. */
  const uint8_t* require(size_t count);
  /** \param count no more bytes than are ready. */
  void skip(size_t count) { cursor_ += count; }
  /** The bytes from an offset on that moveTo() accepts. */
  const uint8_t* dataAt(uint64_t offset) const { return buffer_.data() + (offset - buffer_start_); }

  /** Allows to forget what lies before the position. */
  void mark();
  /** \param offset not before the last mark, not behind what was prepared. */
  void moveTo(uint64_t offset);

  /** True if a read wanted more bytes than there were since the last mark. */
  bool ranOut() const { return ran_out_; }
  /** Why the data end before the end of the file, or empty. */
  const std::string& error() const { return error_; }
  /** Compressed bytes read over the size of the file. */
  double progress() const;

  /** All or nothing. \throws std::runtime_error at the end of the data. */
  size_t Read(void* buffer, size_t count) override;
  /** For reading only. \throws std::logic_error. */
  size_t Write(const void* buffer, size_t count) override;
  uint64_t Seek(int64_t offset, TSeekOrigin origin) override;
  uint64_t getTotalBytesCount() const override;
  uint64_t getPosition() const override { return position(); }

 private:
  struct Close {
    void operator()(gzFile file) const { gzclose_r(file); }
  };
  void fetch();

  std::unique_ptr<gzFile_s, Close> file_;
  uint64_t file_size_ = 0;
  std::vector<uint8_t> buffer_;
  uint64_t buffer_start_ = 0;
  size_t cursor_ = 0;
  size_t mark_ = 0;
  bool at_end_ = false;
  bool ran_out_ = false;
  std::string error_;
};

}  // namespace lamp
