#include "g2o/G2oLines.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <stdexcept>
#include <string_view>

#include "g2o/RoundedInformation.h"
#include "lamp/core/Csv.h"
#include "lamp/core/GraphFiles.h"

namespace lamp {

namespace {

constexpr bool kPlane = true, kSpace = false, kWithParameter = true;
constexpr G2oTag kTags[] = {
    {"VERTEX_SE2", kPlane, G2oKind::kPose, 1, 3},
    {"VERTEX_SE3:QUAT", kSpace, G2oKind::kPose, 1, 7},
    {"EDGE_SE2", kPlane, G2oKind::kRelativePose, 2, 3 + 6},
    {"EDGE_SE3:QUAT", kSpace, G2oKind::kRelativePose, 2, 7 + 21},
    {"EDGE_SE2_SWITCHABLE", kPlane, G2oKind::kRelativePose, 2, 3 + 6, kWithParameter},
    {"EDGE_SE3_SWITCHABLE", kSpace, G2oKind::kRelativePose, 2, 7 + 21, kWithParameter},
    {"EDGE_PRIOR_SE2", kPlane, G2oKind::kPriorPose, 1, 3 + 6},
    {"EDGE_SE2_PRIOR", kPlane, G2oKind::kPriorPose, 1, 3 + 6},
    {"EDGE_SE3_PRIOR", kSpace, G2oKind::kPriorPose, 1, 7 + 21, kWithParameter},
    {"EDGE_PRIOR_SE2_XY", kPlane, G2oKind::kPriorPosition, 1, 2 + 3},
    {"EDGE_POINTXYZ_PRIOR", kSpace, G2oKind::kPriorPosition, 1, 3 + 6},
    {"EDGE_SE3_PRIOR_XYZ", kSpace, G2oKind::kPriorPosition, 1, 3 + 6},
    {"VERTEX_XY", kPlane, G2oKind::kLandmark, 1, 2},
    {"VERTEX_TRACKXYZ", kSpace, G2oKind::kLandmark, 1, 3},
    {"EDGE_SE2_XY", kPlane, G2oKind::kSighting, 2, 2 + 3},
    {"EDGE_SE3_TRACKXYZ", kSpace, G2oKind::kSighting, 2, 3 + 6, kWithParameter},
    {"PARAMS_SE3OFFSET", kSpace, G2oKind::kOffset, 1, 7},
};
constexpr G2oTag kFix{"FIX", kSpace, G2oKind::kFixed, 1, 0};

/** Information times squared positions must stay finite. */
constexpr double kLargest = 1e60;

using Words = std::vector<std::string>;

/** Puts a small matrix at some axes of an information matrix. */
template <size_t kSize>
void scatter(const Eigen::MatrixXd& m, const int (&axes)[kSize], Matrix6d& information) {
  for (size_t i = 0; i < kSize; ++i)
    for (size_t j = 0; j < kSize; ++j)
      information(axes[i], axes[j]) = m(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
}

Eigen::MatrixXd symmetricFrom(const double* upper, Eigen::Index size) {
  Eigen::MatrixXd m(size, size);
  for (Eigen::Index i = 0; i < size; ++i)
    for (Eigen::Index j = i; j < size; ++j) m(i, j) = m(j, i) = *upper++;
  return m;
}

/** Takes a line off the text, whatever ends it. */
std::string_view takeLine(std::string_view& text) {
  const size_t end = std::min(text.find_first_of("\r\n"), text.size());
  const std::string_view line = text.substr(0, end);
  text.remove_prefix(std::min(text.size(), end + (text.substr(end, 2) == "\r\n" ? 2 : 1)));
  return line;
}

/** The words of a line up to a comment, of which Matlab's start with %. */
Words wordsOf(std::string_view line) {
  constexpr const char* kSpaces = " \t\v\f";
  line = line.substr(0, line.find_first_of("#%"));
  Words words;
  for (size_t at = 0; (at = line.find_first_not_of(kSpaces, at)) != std::string_view::npos;) {
    const size_t end = std::min(line.find_first_of(kSpaces, at), line.size());
    words.emplace_back(line.substr(at, end - at));
    at = end;
  }
  return words;
}

/** The text without a byte order mark. */
std::string_view plainText(std::string_view text, const std::string& name) {
  constexpr std::string_view kUtf8 = "\xEF\xBB\xBF";
  if (text.find('\0') != std::string_view::npos)
    throw std::runtime_error(name +
                             ": is not plain text (it has zero bytes); UTF-16 has to be "
                             "saved as UTF-8");
  return text.substr(text.substr(0, kUtf8.size()) == kUtf8 ? kUtf8.size() : 0);
}

/** One line; throws what is wrong with it. */
class LineReader {
 public:
  LineReader(const Words& words, G2oLine& line, std::string where)
      : words_(words), line_(line), tag_(*line.tag), where_(std::move(where)) {}

  void read() {
    size_t ids = tag_.ids;
    if (line_.is(G2oKind::kFixed))
      ids = std::max<size_t>(1, words_.size() - 1);
    else if (tag_.parameter && words_.size() == 2 + ids + tag_.numbers)
      ++ids;
    checkCount(ids);
    for (size_t i = 1; i <= ids; ++i) line_.ids.push_back(id(words_[i]));
    std::vector<double> values;
    for (size_t i = 1 + ids; i < words_.size(); ++i) values.push_back(number(words_[i]));
    if (!line_.is(G2oKind::kFixed) && ids > tag_.ids) {
      line_.parameter = line_.ids.back();
      line_.ids.pop_back();
    }
    if (line_.is(G2oKind::kRelativePose) && line_.ids[0] == line_.ids[1])
      refuse("joins a node with itself");
    take(values);
  }

 private:
  [[noreturn]] void refuse(const std::string& why) const {
    throw std::runtime_error(where_ + ": " + why);
  }

  void checkCount(size_t ids) const {
    const size_t has = words_.size() - 1, needs = ids + tag_.numbers;
    if (has == needs) return;
    const bool may_lack = line_.is(G2oKind::kRelativePose) || line_.is(G2oKind::kPriorPose);
    if (may_lack && has == ids + (tag_.planar ? 3 : 7))
      refuse(
          "has no information matrix: " + std::to_string(tag_.planar ? 6 : 21) +
          " more numbers, its upper triangle row by row; how exact an edge is cannot be guessed");
    refuse("has " + std::to_string(has) + " values, but needs " + std::to_string(needs) +
           (tag_.parameter ? ", or one more id" : ""));
  }

  uint64_t id(const std::string& word) const {
    uint64_t value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc() || end != word.data() + word.size())
      refuse("'" + word + "' is not an id: a whole number from 0, of up to 64 bits");
    return value;
  }

  double number(const std::string& word) const {
    double value = 0;
    if (!parseDouble(word, value))
      refuse("'" + word + "' is not a number" +
             (word.find(',') == std::string::npos
                  ? ""
                  : "; write decimal points, and spaces between numbers"));
    if (!std::isfinite(value)) refuse("'" + word + "' is not finite");
    if (std::abs(value) > kLargest) refuse("'" + word + "' is too large to compute with");
    return value;
  }

  void take(const std::vector<double>& v) {
    takeNumbers(v);
    line_.rounded = mendRounding(line_.information);
  }

  void takeNumbers(const std::vector<double>& v) {
    switch (tag_.kind) {
      case G2oKind::kLandmark:
      case G2oKind::kSighting:
      case G2oKind::kPriorPosition:
        return takePosition(v);
      case G2oKind::kPose:
      case G2oKind::kOffset:
      case G2oKind::kRelativePose:
      case G2oKind::kPriorPose:
        return takePose(v);
      case G2oKind::kFixed:
        return;
    }
  }

  void takePosition(const std::vector<double>& v) {
    const int axes = tag_.planar ? 2 : 3;
    line_.pose.translation().head(axes) = Eigen::Map<const Eigen::VectorXd>(v.data(), axes);
    if (line_.is(G2oKind::kLandmark)) return;
    line_.information.setZero();
    line_.information.topLeftCorner(axes, axes) = symmetricFrom(v.data() + axes, axes);
  }

  void takePose(const std::vector<double>& v) {
    line_.pose = tag_.planar ? planarPose(v[0], v[1], v[2]) : quaternionFrom(v);
    if (line_.is(G2oKind::kPose) || line_.is(G2oKind::kOffset)) return;
    if (tag_.planar)
      scatter(symmetricFrom(v.data() + 3, 3), kPlanarAxes, line_.information);
    else
      line_.information = fromG2oInformation(symmetricFrom(v.data() + 7, 6));
  }

  Pose3 quaternionFrom(const std::vector<double>& v) const {
    const Eigen::Quaterniond q(v[6], v[3], v[4], v[5]);
    if (!(q.norm() > 1e-6 && q.norm() < 1e6))
      refuse("the quaternion is zero, or far from unit length");
    Pose3 pose = Pose3::Identity();
    pose.translation() << v[0], v[1], v[2];
    pose.linear() = q.normalized().toRotationMatrix();
    return pose;
  }

  const Words& words_;
  G2oLine& line_;
  const G2oTag& tag_;
  const std::string where_;
};

const G2oTag* findTag(const std::string& word) {
  if (word == kFix.name) return &kFix;
  const auto* tag = std::find_if(std::begin(kTags), std::end(kTags),
                                 [&](const G2oTag& t) { return word == t.name; });
  return tag == std::end(kTags) ? nullptr : tag;
}

}  // namespace

std::string G2oLines::where(const G2oLine& line) const {
  std::string text = name + ":" + std::to_string(line.number) + ": " + line.tag->name;
  for (const uint64_t id : line.ids) text += " " + std::to_string(id);
  return text;
}

G2oLines parseG2oLines(const std::string& text, const std::string& name) {
  G2oLines result{name, {}, {}};
  std::string_view rest = plainText(text, name);
  for (size_t number = 1; !rest.empty(); ++number) {
    const Words words = wordsOf(takeLine(rest));
    if (words.empty()) continue;
    G2oLine line;
    line.tag = findTag(words[0]);
    line.number = number;
    if (!line.tag) {
      ++result.skipped[words[0]];
      continue;
    }
    std::string where = name + ":" + std::to_string(number) + ": " + words[0];
    for (size_t i = 1; i <= line.tag->ids && i < words.size(); ++i) where += " " + words[i];
    LineReader(words, line, std::move(where)).read();
    result.lines.push_back(std::move(line));
  }
  return result;
}

}  // namespace lamp
