#include "g2o/G2oNodes.h"

#include <cctype>
#include <stdexcept>

namespace lamp {

namespace {

constexpr int kNumberBits = 56;

[[noreturn]] void refuse(const std::string& where, const std::string& why) {
  throw std::runtime_error(where + ": " + why);
}

}  // namespace

G2oNodes::G2oNodes(const G2oLines& file) : file_(file) {
  for (const G2oLine& line : file.lines) collect(line);
  for (const G2oLine& line : file.lines)
    for (const uint64_t id : line.ids)
      if (poses_.count(id) && landmarks_.count(id))
        refuse(file.where(line), "node " + std::to_string(id) + " is a pose and a landmark");
  for (const G2oLine& line : file.lines)
    if (line.is(G2oKind::kFixed)) fix(line);
  checkFixed();
}

void G2oNodes::collect(const G2oLine& line) {
  switch (line.tag->kind) {
    case G2oKind::kPose:
      return addVertex(line, poses_[line.ids[0]]);
    case G2oKind::kLandmark:
      return addVertex(line, landmarks_[line.ids[0]]);
    case G2oKind::kRelativePose:
      poses_[line.ids[1]];
      poses_[line.ids[0]];
      return;
    case G2oKind::kPriorPose:
    case G2oKind::kPriorPosition:
      poses_[line.ids[0]];
      return;
    case G2oKind::kSighting:
      poses_[line.ids[0]];
      landmarks_[line.ids[1]];
      return;
    case G2oKind::kOffset:
      offsets_[line.ids[0]] = line.pose;
      return;
    case G2oKind::kFixed:
      return;
  }
}

void G2oNodes::addVertex(const G2oLine& line, Node& node) const {
  if (node.vertex && node.vertex->pose.matrix() != line.pose.matrix())
    refuse(file_.where(line), "line " + std::to_string(node.vertex->number) +
                                  " has another pose for the same node; leave one of them out");
  node.vertex = &line;
}

void G2oNodes::fix(const G2oLine& line) {
  for (const uint64_t id : line.ids) {
    const auto pose = poses_.find(id);
    const auto landmark = landmarks_.find(id);
    if (pose == poses_.end() && landmark == landmarks_.end())
      refuse(file_.where(line), "the file has no node " + std::to_string(id));
    (pose == poses_.end() ? landmark : pose)->second.fixed = &line;
  }
}

/** A single one may be anywhere. */
void G2oNodes::checkFixed() const {
  size_t fixed = 0;
  for (const auto* nodes : {&poses_, &landmarks_})
    for (const auto& [id, node] : *nodes) fixed += node.fixed != nullptr;
  if (fixed < 2) return;
  for (const auto* nodes : {&poses_, &landmarks_})
    for (const auto& [id, node] : *nodes)
      if (node.fixed && !node.vertex)
        refuse(file_.where(*node.fixed),
               "node " + std::to_string(id) + " has no VERTEX line that says where it is fixed");
}

Pose3 G2oNodes::offset(const G2oLine& line) const {
  const auto found = offsets_.find(line.parameter);
  if (found != offsets_.end()) return found->second;
  if (line.parameter != 0)
    refuse(file_.where(line), "there is no PARAMS_SE3OFFSET " + std::to_string(line.parameter));
  return Pose3::Identity();
}

char letterOf(uint64_t id) {
  const auto letter = static_cast<unsigned char>(id >> kNumberBits);
  const bool is_ascii = letter < 128;
  return is_ascii && std::isalpha(letter) ? static_cast<char>(letter) : '\0';
}

uint64_t numberOf(uint64_t id) {
  return id & ((uint64_t{1} << kNumberBits) - 1);
}

}  // namespace lamp
