#include "RewindableStream.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <stdexcept>

namespace lamp {
namespace {

constexpr size_t kChunk = size_t{64} << 10;
constexpr size_t kForgetAt = size_t{1} << 20;

uint64_t sizeOfFile(const std::string& path) {
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (!std::filesystem::exists(status)) {
    throw std::runtime_error(path + ": no such file; check the path of the rawlog");
  }
  if (!std::filesystem::is_regular_file(status)) {
    throw std::runtime_error(path + ": not a file; give the path of a rawlog");
  }
  const uint64_t size = std::filesystem::file_size(path);
  if (size == 0) throw std::runtime_error(path + ": the file is empty");
  return size;
}

}  // namespace

RewindableStream::RewindableStream(const std::string& path) : file_size_(sizeOfFile(path)) {
  file_.reset(gzopen(path.c_str(), "rb"));
  if (!file_) throw std::runtime_error(path + ": cannot be opened: " + std::strerror(errno));
  gzbuffer(file_.get(), kChunk);
}

size_t RewindableStream::prepare(size_t count) {
  while (buffer_.size() - cursor_ < count && !at_end_) fetch();
  return buffer_.size() - cursor_;
}

void RewindableStream::fetch() {
  const size_t old_size = buffer_.size();
  buffer_.resize(old_size + kChunk);
  const int got = gzread(file_.get(), buffer_.data() + old_size, kChunk);
  buffer_.resize(old_size + static_cast<size_t>(std::max(got, 0)));
  if (got == static_cast<int>(kChunk)) return;
  at_end_ = true;
  int code = Z_OK;
  const char* text = gzerror(file_.get(), &code);
  if (code == Z_BUF_ERROR) {
    error_ = "the compressed file is cut off";
  } else if (code != Z_OK && code != Z_STREAM_END) {
    error_ = std::string("the file cannot be decompressed beyond this point (") + text + ")";
  }
}

void RewindableStream::mark() {
  ran_out_ = false;
  mark_ = cursor_;
  if (mark_ < kForgetAt) return;
  buffer_.erase(buffer_.begin(), buffer_.begin() + static_cast<std::ptrdiff_t>(mark_));
  buffer_start_ += mark_;
  cursor_ = mark_ = 0;
}

void RewindableStream::moveTo(uint64_t offset) {
  if (offset < buffer_start_ + mark_ || offset > buffer_start_ + buffer_.size()) {
    throw std::logic_error("RewindableStream: offset is not kept");
  }
  cursor_ = static_cast<size_t>(offset - buffer_start_);
}

double RewindableStream::progress() const {
  if (at_end_) return 1.0;
  const double read = static_cast<double>(gzoffset(file_.get()));
  return std::clamp(read / static_cast<double>(file_size_), 0.0, 1.0);
}

const uint8_t* RewindableStream::require(size_t count) {
  if (count > kMaxKeptBytes - std::min(cursor_ - mark_, kMaxKeptBytes)) {
    throw std::runtime_error("object larger than any a rawlog can hold");
  }
  if (prepare(count) < count) {
    ran_out_ = true;
    throw std::runtime_error("end of the data");
  }
  return data();
}

size_t RewindableStream::Read(void* buffer, size_t count) {
  const uint8_t* const bytes = require(count);
  if (count > 0) std::memcpy(buffer, bytes, count);
  skip(count);
  return count;
}

size_t RewindableStream::Write(const void*, size_t) {
  throw std::logic_error("RewindableStream: for reading only");
}

uint64_t RewindableStream::Seek(int64_t, TSeekOrigin) {
  throw std::logic_error("RewindableStream: use moveTo()");
}

uint64_t RewindableStream::getTotalBytesCount() const {
  throw std::logic_error("RewindableStream: the uncompressed size is not known");
}

}  // namespace lamp
