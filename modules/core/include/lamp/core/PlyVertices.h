#pragma once

#include <functional>
#include <istream>
#include <string>
#include <vector>

namespace lamp {

/** The vertices of a PLY file, ASCII or binary little-endian, read one by one: files may be larger
 * than the memory. Other elements and properties are skipped. */
class PlyVertices {
 public:
  /** Reads the header. \throws std::runtime_error naming the file if it cannot be read, is no PLY,
   *  is big-endian, or its vertices do not come first or have lists. */
  explicit PlyVertices(const std::string& path);

  /** What becomes of values that are no finite numbers. */
  enum class NotFinite {
    kRefuse,  ///< an error
    kTake,    ///< they are values like any other
  };

  size_t count() const { return count_; }
  bool has(const std::string& property) const;
  /** Calls `take` for each vertex with the named properties' values, in that order.
   * \throws std::runtime_error naming the file if it has no such property, ends early, or a value
   * is no finite number where that is refused. */
  void read(const std::vector<std::string>& properties,
            const std::function<void(const double*)>& take,
            NotFinite not_finite = NotFinite::kRefuse) const;

 private:
  struct Property {
    std::string name;
    size_t offset = 0;                       ///< in a binary vertex
    double (*value)(const char*) = nullptr;  ///< from the bytes of a binary vertex
  };
  void readHeader(std::istream& file);
  void checkSize() const;
  void takeHeaderLine(const std::string& line, std::string& element);
  void addProperty(const std::string& type, const std::string& name);
  std::vector<size_t> placesOf(const std::vector<std::string>& properties) const;
  bool readVertex(std::istream& file, std::vector<double>& values) const;
  [[noreturn]] void fail(const std::string& what) const;

  std::string path_;
  bool binary_ = false;
  size_t count_ = 0, stride_ = 0;
  std::streamoff data_ = 0;  ///< where the vertices begin
  std::vector<Property> properties_;
};

}  // namespace lamp
