#include "g2o/G2oEdgeLines.h"

#include <algorithm>
#include <map>

#include "lamp/core/GraphFiles.h"

namespace lamp {

namespace {

bool isEdge(const G2oLine& line) {
  return line.is(G2oKind::kRelativePose) || line.is(G2oKind::kSighting) ||
         line.is(G2oKind::kPriorPose) || line.is(G2oKind::kPriorPosition);
}

bool isEmpty(const G2oLine& line) {
  if (!line.tag->planar) return line.information.isZero(0);
  return std::all_of(std::begin(kPlanarAxes), std::end(kPlanarAxes),
                     [&](int axis) { return line.information(axis, axis) == 0; });
}

bool sameEdge(const G2oLine& a, const G2oLine& b) {
  return a.tag == b.tag && a.parameter == b.parameter && a.pose.matrix() == b.pose.matrix() &&
         a.information == b.information;
}

bool isIdentity(const G2oLine& line) {
  const Matrix6d identity = Matrix6d::Identity();
  return line.information == (line.tag->planar ? identity : fromG2oInformation(identity));
}

}  // namespace

std::vector<const G2oLine*> telling(const G2oLines& file, std::vector<std::string>& notes) {
  std::vector<const G2oLine*> edges;
  std::map<std::vector<uint64_t>, std::vector<const G2oLine*>> by_ids;
  size_t empty = 0, repeated = 0, rounded = 0;
  for (const G2oLine& line : file.lines) {
    if (!isEdge(line)) continue;
    if (isEmpty(line)) {
      ++empty;
      continue;
    }
    std::vector<const G2oLine*>& others = by_ids[line.ids];
    repeated += std::any_of(others.begin(), others.end(),
                            [&](const G2oLine* other) { return sameEdge(*other, line); });
    rounded += line.rounded;
    others.push_back(&line);
    edges.push_back(&line);
  }
  const auto note = [&](size_t count, const char* what) {
    if (count > 0) notes.push_back(std::to_string(count) + what);
  };
  note(empty, " edge(s) have zero information and are left out");
  note(repeated, " edge(s) repeat another one word for word; loop closures count once");
  note(rounded,
       " edge(s) have information that is not positive semi-definite, but by its rounding only; it "
       "is mended");
  return edges;
}

InformationKind informationKind(const std::vector<const G2oLine*>& edges) {
  const G2oLine* first = nullptr;
  for (const G2oLine* line : edges) {
    if (!line->is(G2oKind::kRelativePose)) continue;
    if (!first) first = line;
    if (line->information != first->information) return InformationKind::kStated;
  }
  if (!first) return InformationKind::kStated;
  return isIdentity(*first) ? InformationKind::kIdentity : InformationKind::kConstant;
}

}  // namespace lamp
