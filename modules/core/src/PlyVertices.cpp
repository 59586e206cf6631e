#include "lamp/core/PlyVertices.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <stdexcept>

#include "CloudText.h"
#include "PlyHeader.h"
#include "lamp/core/Files.h"

namespace lamp {

namespace {

bool isSameName(const std::string& a, const std::string& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](unsigned char x, unsigned char y) {
    return std::tolower(x) == std::tolower(y);
  });
}

/** Reads the elements of a file one after the other, value by value. */
class PlyElements {
 public:
  virtual ~PlyElements() = default;
  /** The next element's values, of lists 0. \return false at the end of the file. */
  virtual bool read(const PlyElement& element, std::vector<double>& values) = 0;
  virtual std::string place() const { return ""; }
};

/** One element a line. */
class AsciiElements : public PlyElements {
 public:
  AsciiElements(std::istream& file, const std::string& name, size_t header_lines)
      : text_(file, name, header_lines) {}

  bool read(const PlyElement& element, std::vector<double>& values) override {
    if (!text_.next(words_)) return false;
    values.clear();
    size_t next = 0;
    for (const PlyProperty& property : element.properties) {
      const double value = number(next++);
      values.push_back(property.length ? 0 : value);
      if (!property.length) continue;
      if (!(value >= 0 && value <= static_cast<double>(words_.size() - next)))
        text_.fail("the line ends within a list");
      next += static_cast<size_t>(value);
    }
    if (next < words_.size())
      text_.fail("has " + std::to_string(words_.size()) + " values instead of " +
                 std::to_string(next) + " of a " + element.name);
    return true;
  }
  std::string place() const override { return " in line " + std::to_string(text_.line()); }

 private:
  double number(size_t place) const {
    if (place >= words_.size()) text_.fail("has only " + std::to_string(words_.size()) + " values");
    return text_.number(words_[place]);
  }

  CloudText text_;
  std::vector<std::string> words_;
};

class BinaryElements : public PlyElements {
 public:
  BinaryElements(std::istream& file, bool big_endian) : file_(file), big_endian_(big_endian) {}

  bool read(const PlyElement& element, std::vector<double>& values) override {
    values.clear();
    return element.hasLists() ? readOneByOne(element, values) : readAtOnce(element, values);
  }

 private:
  bool readAtOnce(const PlyElement& element, std::vector<double>& values) {
    bytes_.resize(element.bytes());
    if (!file_.read(bytes_.data(), static_cast<std::streamsize>(bytes_.size()))) return false;
    const char* next = bytes_.data();
    for (const PlyProperty& property : element.properties) {
      values.push_back(valueOf(property.scalar, next));
      next += property.scalar.size;
    }
    return true;
  }

  bool readOneByOne(const PlyElement& element, std::vector<double>& values) {
    for (const PlyProperty& property : element.properties) {
      const Scalar& scalar = property.length ? *property.length : property.scalar;
      char bytes[sizeof(double)];
      if (!file_.read(bytes, static_cast<std::streamsize>(scalar.size))) return false;
      const double value = valueOf(scalar, bytes);
      values.push_back(property.length ? 0 : value);
      if (property.length && !skip(value, property.scalar.size)) return false;
    }
    return true;
  }

  double valueOf(const Scalar& scalar, const char* bytes) const {
    return big_endian_ ? scalar.bigEndian(bytes) : scalar.value(bytes);
  }

  bool skip(double count, size_t size) {
    if (!(count >= 0 && count < 1e9)) return false;
    file_.ignore(static_cast<std::streamsize>(count) * static_cast<std::streamsize>(size));
    return !file_.eof();
  }

  std::istream& file_;
  const bool big_endian_;
  std::vector<char> bytes_;
};

std::unique_ptr<PlyElements> elementsOf(std::istream& file, const std::string& name,
                                        const PlyHeader& header) {
  if (header.data == PlyData::kAscii)
    return std::make_unique<AsciiElements>(file, name, header.lines);
  return std::make_unique<BinaryElements>(file, header.data == PlyData::kBigEndian);
}

}  // namespace

PlyVertices::PlyVertices(const std::string& path) : PlyVertices(openedToRead(path), path) {}

PlyVertices::PlyVertices(std::unique_ptr<std::istream> file, std::string name)
    : file_(std::move(file)),
      name_(std::move(name)),
      header_(std::make_unique<const PlyHeader>(PlyHeader::read(*file_, name_))),
      data_(file_->tellg()) {
  checkSize();
}

PlyVertices::~PlyVertices() = default;

/** A damaged header may announce more vertices than any memory has room for. */
void PlyVertices::checkSize() const {
  const PlyElement& vertex = header_->vertex();
  const size_t least_bytes =
      header_->data == PlyData::kAscii ? 2 * vertex.properties.size() : vertex.bytes();
  file_->clear();
  file_->seekg(0, std::ios::end);
  // The last line of a text may lack its end; an empty file has no place to go on from.
  const auto there = static_cast<size_t>(std::max<std::streamoff>(0, file_->tellg() - data_)) + 1;
  if (vertex.count > there / least_bytes)
    fail("is too short for the " + std::to_string(vertex.count) +
         " vertices that its header announces");
}

size_t PlyVertices::count() const {
  return header_->vertex().count;
}

const Eigen::Vector3d& PlyVertices::offset() const {
  return header_->offset;
}

bool PlyVertices::has(const std::string& property) const {
  const auto& properties = header_->vertex().properties;
  return std::any_of(properties.begin(), properties.end(), [&](const PlyProperty& p) {
    return !p.length && isSameName(p.name, property);
  });
}

std::vector<size_t> PlyVertices::placesOf(const std::vector<std::string>& properties) const {
  const auto& all = header_->vertex().properties;
  std::vector<size_t> places;
  for (const std::string& name : properties) {
    const auto found = std::find_if(all.begin(), all.end(), [&](const PlyProperty& p) {
      return !p.length && isSameName(p.name, name);
    });
    if (found == all.end()) fail("has vertices without '" + name + "'");
    places.push_back(static_cast<size_t>(found - all.begin()));
  }
  return places;
}

void PlyVertices::read(const std::vector<std::string>& properties,
                       const std::function<void(const double*)>& take, NotFinite not_finite) const {
  const std::vector<size_t> places = placesOf(properties);
  file_->clear();
  file_->seekg(data_);
  const auto elements = elementsOf(*file_, name_, *header_);
  std::vector<double> values, taken(places.size());
  const auto next = [&](const PlyElement& element, size_t i) {
    if (!elements->read(element, values))
      fail("ends or is malformed at " + element.name + " " + std::to_string(i + 1) + " of " +
           std::to_string(element.count));
  };
  for (size_t e = 0; e < header_->vertices; ++e) {
    const PlyElement& element = header_->elements[e];
    for (size_t i = 0; i < element.count && !element.properties.empty(); ++i) next(element, i);
  }
  for (size_t i = 0; i < count(); ++i) {
    next(header_->vertex(), i);
    for (size_t k = 0; k < places.size(); ++k) {
      taken[k] = values[places[k]];
      if (not_finite == NotFinite::kRefuse && !std::isfinite(taken[k]))
        fail("has a value that is not finite in vertex " + std::to_string(i + 1) +
             elements->place());
    }
    take(taken.data());
  }
}

void PlyVertices::fail(const std::string& what) const {
  throw std::runtime_error("'" + name_ + "' " + what);
}

}  // namespace lamp
