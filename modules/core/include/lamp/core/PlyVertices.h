#pragma once

#include <Eigen/Core>
#include <functional>
#include <istream>
#include <memory>
#include <string>
#include <vector>

namespace lamp {

struct PlyHeader;

/** The vertices of a PLY file, ASCII or binary of either byte order, read one by one: files may be
 * larger than the memory. Other elements, other properties and lists are skipped. Names of
 * properties are told apart without regard to case. */
class PlyVertices {
 public:
  /** Reads the header. \throws std::runtime_error naming the file, and the line in its header, if
   *  it cannot be read or is no PLY with vertices. */
  explicit PlyVertices(const std::string& path);
  /** \param file can be sought in; \param name of the file, for messages. */
  PlyVertices(std::unique_ptr<std::istream> file, std::string name);
  ~PlyVertices();

  /** What becomes of values that are no finite numbers. */
  enum class NotFinite {
    kRefuse,  ///< an error
    kTake,    ///< they are values like any other
  };

  size_t count() const;
  bool has(const std::string& property) const;
  /** What is to be added to `x y z` to get world coordinates: a line `comment offset X Y Z`. */
  const Eigen::Vector3d& offset() const;
  /** Calls `take` for each vertex with the named properties' values, in that order.
   * \throws std::runtime_error naming the file, and the line of a text, if it has no such property,
   * ends early, or a value is not a finite number where that is refused. */
  void read(const std::vector<std::string>& properties,
            const std::function<void(const double*)>& take,
            NotFinite not_finite = NotFinite::kRefuse) const;

 private:
  void checkSize() const;
  std::vector<size_t> placesOf(const std::vector<std::string>& properties) const;
  [[noreturn]] void fail(const std::string& what) const;

  const std::unique_ptr<std::istream> file_;
  const std::string name_;
  std::unique_ptr<const PlyHeader> header_;
  std::streamoff data_ = 0;  ///< where the elements begin
};

}  // namespace lamp
