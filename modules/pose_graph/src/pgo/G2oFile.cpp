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

enum class LineKind {
  kPose,
  kRelativePose,
  kLandmark,
  kSighting,  ///< of a landmark from a pose
  kOffset,    ///< of a sensor, a parameter of sightings in space
};

/** One kind of line: how many ids and numbers it has. */
struct Tag {
  const char* name;
  bool planar;
  LineKind kind;
  size_t ids, numbers;
};
constexpr Tag kTags[] = {{"VERTEX_SE2", true, LineKind::kPose, 1, 3},
                         {"VERTEX_SE3:QUAT", false, LineKind::kPose, 1, 7},
                         {"EDGE_SE2", true, LineKind::kRelativePose, 2, 3 + 6},
                         {"EDGE_SE3:QUAT", false, LineKind::kRelativePose, 2, 7 + 21},
                         {"VERTEX_XY", true, LineKind::kLandmark, 1, 2},
                         {"VERTEX_TRACKXYZ", false, LineKind::kLandmark, 1, 3},
                         {"EDGE_SE2_XY", true, LineKind::kSighting, 2, 2 + 3},
                         {"EDGE_SE3_TRACKXYZ", false, LineKind::kSighting, 3, 3 + 6},
                         {"PARAMS_SE3OFFSET", false, LineKind::kOffset, 1, 7}};

struct Line {
  const Tag* tag;
  std::string where;  ///< file, line, tag and ids
  std::vector<uint64_t> ids;
  Pose3 pose = Pose3::Identity();
  Matrix6d information = Matrix6d::Identity();

  bool is(LineKind kind) const { return tag->kind == kind; }
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

/** A point of 2 or 3 coordinates, and what is behind them of its information. */
void readPoint(const std::vector<double>& v, Line& line) {
  const int axes = line.tag->planar ? 2 : 3;
  line.pose.translation().head(axes) = Eigen::Map<const Eigen::VectorXd>(v.data(), axes);
  line.information.setZero();
  if (line.is(LineKind::kSighting))
    line.information.topLeftCorner(axes, axes) = symmetricFrom(v.data() + axes, axes);
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
    if (line.is(LineKind::kRelativePose) && line.ids[0] == line.ids[1])
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
    if (line.is(LineKind::kLandmark) || line.is(LineKind::kSighting)) return readPoint(v, line);
    line.pose = line.tag->planar ? planarFrom(v.data()) : quaternionFrom(v.data(), line.where);
    if (!line.is(LineKind::kRelativePose)) return;
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
      collectIds(line);
    }
    for (const auto& [id, landmark] : landmarks_)
      if (nodes_.count(id))
        throw std::runtime_error("g2o: " + std::to_string(id) + " is a pose and a landmark");
    nameNodes();
    for (const Line& line : lines)
      if (line.is(LineKind::kPose)) nodes_[line.ids[0]].world_T_base = line.pose;
    for (const auto& [id, node] : nodes_) {
      result_.graph.addNode(node);
      result_.ids.push_back(id);
    }
    for (auto& [id, landmark] : landmarks_) {
      landmark.name = std::to_string(id);
      result_.graph.addLandmark(landmark);
    }
    for (const Line& line : lines) {
      if (line.is(LineKind::kRelativePose)) addEdge(line);
      if (line.is(LineKind::kSighting)) addSighting(line);
    }
    placeNodesWithoutVertex(lines);
    placeLandmarksWithoutVertex();
    return std::move(result_);
  }

 private:
  void collectIds(const Line& line) {
    if (line.is(LineKind::kOffset)) offsets_[line.ids[0]] = line.pose;
    if (line.is(LineKind::kLandmark))
      landmarks_[line.ids[0]] = {"", line.pose.translation(), false, true};
    if (line.is(LineKind::kSighting)) landmarks_[line.ids[1]];
    const size_t poses = line.is(LineKind::kRelativePose)
                             ? 2
                             : line.is(LineKind::kPose) || line.is(LineKind::kSighting);
    for (size_t i = 0; i < poses; ++i) nodes_[line.ids[i]].planar = line.tag->planar;
  }

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
    add(edge, line);
  }

  void addSighting(const Line& line) {
    Pose3 base_T_sensor = Pose3::Identity();
    if (!line.tag->planar) {
      const auto offset = offsets_.find(line.ids[2]);
      if (offset == offsets_.end())
        refuse(line.where, "there is no PARAMS_SE3OFFSET " + std::to_string(line.ids[2]));
      base_T_sensor = offset->second;
    }
    Edge edge;
    edge.type = EdgeType::kPosition;
    edge.from = edge.to = nodes_.at(line.ids[0]).id;
    edge.landmark = *result_.graph.findLandmark(std::to_string(line.ids[1]));
    edge.from_T_to.translation() = base_T_sensor * line.pose.translation();
    const Matrix6d turn = adjoint(Pose3(Eigen::Quaterniond(base_T_sensor.linear())));
    edge.information = turn * line.information * turn.transpose();
    edge.verdict = Verdict::kPending;
    add(edge, line);
  }

  void add(const Edge& edge, const Line& line) {
    try {
      result_.graph.addEdge(edge);
    } catch (const std::invalid_argument&) {
      refuse(line.where, "the information matrix is not positive semi-definite");
    }
  }

  /** Where the first sighting puts them. */
  void placeLandmarksWithoutVertex() {
    for (const Edge& edge : result_.graph.edges()) {
      if (!edge.endsAtLandmark()) continue;
      Landmark& landmark = result_.graph.landmarks()[edge.landmark];
      if (landmark.placed) continue;
      landmark.world_p = result_.graph.node(edge.from).world_T_base * edge.from_T_to.translation();
      landmark.placed = true;
    }
  }

  void placeNodesWithoutVertex(const std::vector<Line>& lines) {
    const bool complete =
        static_cast<size_t>(std::count_if(lines.begin(), lines.end(), [](const Line& l) {
          return l.is(LineKind::kPose);
        })) >= nodes_.size();
    if (complete) return;
    const std::vector<Pose3> guess = spanningTreeGuess(result_.graph);
    for (size_t i = 0; i < guess.size(); ++i)
      result_.graph.node(result_.graph.nodes()[i].id).world_T_base = guess[i];
  }

  G2oGraph result_;
  std::map<uint64_t, Node> nodes_;
  std::map<uint64_t, Landmark> landmarks_;
  std::map<uint64_t, Pose3> offsets_;
  std::map<uint64_t, bool> has_odometry_;  ///< from this id to the next
};

}  // namespace

std::string G2oGraph::name(KeyNodeId id) const {
  const char letter = letters.at(id.robot.value);
  return letter ? letter + std::to_string(id.index) : std::to_string(ids.at(graph.place(id)));
}

namespace {

std::string numbersOf(const Eigen::VectorXd& values) {
  std::string text;
  for (const double value : values) text += " " + formatDouble(value);
  return text;
}

/** Upper triangle, row by row. */
Eigen::VectorXd upperOf(const Eigen::MatrixXd& m) {
  Eigen::VectorXd values(m.rows() * (m.rows() + 1) / 2);
  Eigen::Index next = 0;
  for (Eigen::Index i = 0; i < m.rows(); ++i)
    for (Eigen::Index j = i; j < m.cols(); ++j) values[next++] = m(i, j);
  return values;
}

}  // namespace

std::string toG2o(const G2oGraph& g2o) {
  const PoseGraph& graph = g2o.graph;
  std::string text = toG2o(graph, g2o.ids);
  if (graph.landmarks().empty()) return text;
  const bool planar = graph.planar();
  const int axes = planar ? 2 : 3;
  if (!planar) text += "PARAMS_SE3OFFSET 0 0 0 0 0 0 0 1\n";
  for (const Landmark& landmark : graph.landmarks())
    if (landmark.placed)
      text += std::string(planar ? "VERTEX_XY " : "VERTEX_TRACKXYZ ") + landmark.name +
              numbersOf(landmark.world_p.head(axes)) + "\n";
  for (const Edge& edge : graph.edges()) {
    if (edge.type != EdgeType::kPosition || !edge.active()) continue;
    text += std::string(planar ? "EDGE_SE2_XY " : "EDGE_SE3_TRACKXYZ ") +
            std::to_string(g2o.ids[graph.place(edge.from)]) + " " +
            graph.landmarks()[edge.landmark].name + (planar ? "" : " 0") +
            numbersOf(edge.from_T_to.translation().head(axes)) +
            numbersOf(upperOf(edge.information.topLeftCorner(axes, axes))) + "\n";
  }
  return text;
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
