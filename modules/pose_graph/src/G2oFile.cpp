#include "lamp/pose_graph/G2oFile.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <sstream>
#include <stdexcept>

#include "lamp/core/Csv.h"
#include "lamp/core/Files.h"
#include "lamp/core/GraphFiles.h"
#include "lamp/pose_graph/InitialGuess.h"

namespace lamp {

namespace {

constexpr int kIndexBits = 56;

/** One kind of line: how many ids and numbers it has. */
struct Tag {
  const char* name;
  bool planar, edge;
  size_t ids, numbers;
};
constexpr Tag kTags[] = {{"VERTEX_SE2", true, false, 1, 3},
                         {"VERTEX_SE3:QUAT", false, false, 1, 7},
                         {"EDGE_SE2", true, true, 2, 3 + 6},
                         {"EDGE_SE3:QUAT", false, true, 2, 7 + 21}};

struct Line {
  const Tag* tag;
  std::string where;  ///< file, line, tag and ids
  std::vector<uint64_t> ids;
  Pose3 pose = Pose3::Identity();
  Matrix6d information = Matrix6d::Identity();
};

[[noreturn]] void refuse(const std::string& where, const std::string& why) {
  throw std::runtime_error(where + ": " + why);
}

Pose3 planarFrom(const double* v) {
  return planarPose(v[0], v[1], v[2]);
}

Pose3 quaternionFrom(const double* v, const std::string& where) {
  const Eigen::Quaterniond q(v[6], v[3], v[4], v[5]);
  if (!(q.norm() > 1e-6)) refuse(where, "the quaternion is zero");
  Pose3 pose = Pose3::Identity();
  pose.translation() << v[0], v[1], v[2];
  pose.linear() = q.normalized().toRotationMatrix();
  return pose;
}

Eigen::MatrixXd symmetricFrom(const double* upper, int size) {
  Eigen::MatrixXd m(size, size);
  for (int i = 0; i < size; ++i)
    for (int j = i; j < size; ++j) m(i, j) = m(j, i) = *upper++;
  return m;
}

Matrix6d planarInformation(const double* upper) {
  const Eigen::MatrixXd m = symmetricFrom(upper, 3);
  Matrix6d information = Matrix6d::Identity();
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) information(kPlanarAxes[i], kPlanarAxes[j]) = m(i, j);
  return information;
}

/** Reads the lines one by one. */
class Parser {
 public:
  explicit Parser(const std::string& name) : name_(name) {}

  void parse(const std::string& text) {
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);) {
      ++number_;
      parseLine(line);
    }
  }

  std::vector<Line> lines;
  std::map<std::string, size_t> skipped;

 private:
  void parseLine(const std::string& text) {
    std::istringstream stream(text);
    std::vector<std::string> words;
    for (std::string word; stream >> word;) words.push_back(word);
    if (words.empty() || words[0][0] == '#' || words[0] == "FIX") return;
    const auto* tag = std::find_if(std::begin(kTags), std::end(kTags),
                                   [&](const Tag& t) { return words[0] == t.name; });
    if (tag == std::end(kTags)) {
      ++skipped[words[0]];
      return;
    }
    Line line;
    line.tag = tag;
    line.where = name_ + ":" + std::to_string(number_) + ": " + words[0];
    for (size_t i = 1; i <= tag->ids && i < words.size(); ++i) line.where += " " + words[i];
    if (words.size() != 1 + tag->ids + tag->numbers)
      refuse(line.where, "has " + std::to_string(words.size() - 1) + " values, needs " +
                             std::to_string(tag->ids + tag->numbers));
    readIds(words, line);
    readNumbers(words, line);
    lines.push_back(line);
  }

  static void readIds(const std::vector<std::string>& words, Line& line) {
    for (size_t i = 1; i <= line.tag->ids; ++i) {
      const std::string& word = words[i];
      uint64_t id = 0;
      const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), id);
      if (error != std::errc() || end != word.data() + word.size())
        refuse(line.where, "'" + word + "' is no id of up to 64 bits");
      line.ids.push_back(id);
    }
    if (line.tag->edge && line.ids[0] == line.ids[1])
      refuse(line.where, "joins a node with itself");
  }

  static void readNumbers(const std::vector<std::string>& words, Line& line) {
    std::vector<double> v;
    for (size_t i = 1 + line.tag->ids; i < words.size(); ++i) {
      double value = 0;
      if (!parseDouble(words[i], value)) refuse(line.where, "'" + words[i] + "' is no number");
      if (!std::isfinite(value)) refuse(line.where, "'" + words[i] + "' is not finite");
      v.push_back(value);
    }
    line.pose = line.tag->planar ? planarFrom(v.data()) : quaternionFrom(v.data(), line.where);
    if (!line.tag->edge) return;
    line.information = line.tag->planar ? planarInformation(v.data() + 3)
                                        : fromG2oInformation(symmetricFrom(v.data() + 7, 6));
  }

  std::string name_;
  size_t number_ = 0;
};

bool isSymbol(uint64_t id) {
  return std::isalpha(static_cast<int>(id >> kIndexBits)) != 0;
}

/** Makes the graph of the lines. */
class Builder {
 public:
  G2oGraph build(const std::vector<Line>& lines) {
    for (const Line& line : lines) {
      if (line.tag->planar != lines.front().tag->planar)
        refuse(line.where, "the file mixes SE2 and SE3");
      for (const uint64_t id : line.ids) nodes_[id].planar = line.tag->planar;
    }
    nameNodes();
    for (const Line& line : lines)
      if (!line.tag->edge) nodes_[line.ids[0]].world_T_base = line.pose;
    for (const auto& [id, node] : nodes_) {
      result_.graph.addNode(node);
      result_.ids.push_back(id);
    }
    for (const Line& line : lines)
      if (line.tag->edge) addEdge(line);
    placeNodesWithoutVertex(lines);
    return std::move(result_);
  }

 private:
  /** Robots in the order of their letters. Indices are those of symbols, else the rank of the id:
   * an index has 32 bits only. */
  void nameNodes() {
    uint32_t rank = 0;
    for (auto& [id, node] : nodes_) {
      const char letter = isSymbol(id) ? static_cast<char>(id >> kIndexBits) : '\0';
      auto& letters = result_.letters;
      const auto found = std::find(letters.begin(), letters.end(), letter);
      node.id.robot.value = static_cast<uint16_t>(found - letters.begin());
      if (found == letters.end()) letters.push_back(letter);
      const uint64_t index = letter ? id & ((uint64_t{1} << kIndexBits) - 1) : rank++;
      if (index > UINT32_MAX)
        throw std::runtime_error("g2o: the index of symbol " + std::to_string(id) +
                                 " has more than 32 bits");
      node.id.index = static_cast<uint32_t>(index);
    }
  }

  void addEdge(const Line& line) {
    Edge edge;
    edge.from = nodes_.at(line.ids[0]).id;
    edge.to = nodes_.at(line.ids[1]).id;
    edge.from_T_to = line.pose;
    edge.information = line.information;
    const auto [low, high] = std::minmax(line.ids[0], line.ids[1]);
    const bool successive = high - low == 1 && edge.from.robot == edge.to.robot;
    const bool odometry = successive && !has_odometry_[low];
    edge.type = odometry ? EdgeType::kOdometry : EdgeType::kLoopClosure;
    edge.verdict = odometry ? Verdict::kInlier : Verdict::kPending;
    if (odometry) has_odometry_[low] = true;
    try {
      result_.graph.addEdge(edge);
    } catch (const std::invalid_argument&) {
      refuse(line.where, "the information matrix is not positive semi-definite");
    }
  }

  void placeNodesWithoutVertex(const std::vector<Line>& lines) {
    const bool complete =
        static_cast<size_t>(std::count_if(lines.begin(), lines.end(), [](const Line& l) {
          return !l.tag->edge;
        })) >= nodes_.size();
    if (complete) return;
    const std::vector<Pose3> guess = spanningTreeGuess(result_.graph);
    for (size_t i = 0; i < guess.size(); ++i)
      result_.graph.node(result_.graph.nodes()[i].id).world_T_base = guess[i];
  }

  G2oGraph result_;
  std::map<uint64_t, Node> nodes_;
  std::map<uint64_t, bool> has_odometry_;  ///< from this id to the next
};

}  // namespace

std::string G2oGraph::name(KeyframeId id) const {
  const char letter = letters.at(id.robot.value);
  return letter ? letter + std::to_string(id.index) : std::to_string(ids.at(graph.place(id)));
}

G2oGraph g2oFromText(const std::string& text, const std::string& name) {
  Parser parser(name);
  parser.parse(text);
  if (parser.lines.empty())
    throw std::runtime_error(name + ": holds no line that g2o's SE2 or SE3 know");
  G2oGraph result = Builder().build(parser.lines);
  result.skipped = std::move(parser.skipped);
  return result;
}

G2oGraph readG2oFile(const std::string& path) {
  return g2oFromText(readTextFile(path), path);
}

}  // namespace lamp
