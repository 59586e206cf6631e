#include "OctreeFile.h"

#include <algorithm>
#include <limits>

namespace lamp {

namespace {

/** Levels of octree above the blocks: OctoMap's trees have 16, blocks 3. */
constexpr int kLevelsAboveBlocks = 13;

/** One scan's part in log-odds: the defaults of Hornung et al. for a hit (0.7) and a pass (0.4),
 * and their limits (0.97 and 0.12). */
float logOdds(VoxelState state) {
  constexpr float kHit = 0.847298f, kPass = 0.405465f, kMost = 3.476099f, kLeast = -1.992430f;
  const auto scans = static_cast<float>(state);
  return state > 0 ? std::min(kHit * scans, kMost) : std::max(kPass * scans, kLeast);
}

void writeHeader(const std::string& kind, size_t nodes, double resolution_m,
                 const std::string& comment, std::ostream& file) {
  file << "# Octomap OcTree " << kind << "\n";
  if (!comment.empty()) file << "# " << comment << "\n";
  file << "id OcTree\nsize " << nodes << "\nres " << resolution_m << "\ndata\n";
}

/** The place after the node and all below it. */
size_t endOf(const std::vector<OctreeNodes::Node>& nodes, size_t node) {
  size_t end = node + 1;
  for (uint8_t rest = nodes[node].children; rest != 0; rest &= static_cast<uint8_t>(rest - 1))
    end = endOf(nodes, end);
  return end;
}

/** Of each inner node two bits for each child: 01 free, 10 occupied, 11 inner, 00 unknown. */
uint16_t bonsaiBits(const std::vector<OctreeNodes::Node>& nodes, size_t node) {
  unsigned bits = 0;
  size_t child = node + 1;
  for (unsigned i = 0; i < 8; ++i) {
    if ((nodes[node].children >> i & 1) == 0) continue;
    const unsigned code = nodes[child].children != 0 ? 3 : nodes[child].value > 0 ? 2 : 1;
    bits |= code << (2 * i);
    child = endOf(nodes, child);
  }
  return static_cast<uint16_t>(bits);
}

template <class Number>
void write(Number value, std::ostream& file) {
  static_assert(__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__, "the formats are little endian");
  file.write(reinterpret_cast<const char*>(&value), sizeof(value));
}

}  // namespace

OctreeNodes::OctreeNodes(const VoxelStates& states, bool sure_only) : sure_only_(sure_only) {
  if (!states.empty()) addInner(states, {0, states.size()}, kLevelsAboveBlocks);
}

VoxelState OctreeNodes::valueOf(VoxelState state) const {
  if (!sure_only_ || state == 0) return state;
  return state > 0 ? 1 : -1;
}

/** \param add_child adds the nodes of the n-th child, or none if there is nothing known. */
template <class AddChild>
void OctreeNodes::addParent(AddChild&& add_child) {
  const size_t parent = nodes_.size();
  nodes_.emplace_back();
  Node node{std::numeric_limits<VoxelState>::min(), 0};
  bool equal_leaves = true;
  for (unsigned i = 0; i < 8; ++i) {
    const size_t child = nodes_.size();
    add_child(i);
    if (nodes_.size() == child) continue;
    node.children |= static_cast<uint8_t>(1U << i);
    node.value = std::max(node.value, nodes_[child].value);
    equal_leaves = equal_leaves && nodes_[child].children == 0 &&
                   nodes_[child].value == nodes_[parent + 1].value;
  }
  nodes_.resize(node.children == 0 ? parent : nodes_.size());
  if (node.children == 0) return;
  if (node.children == 0xFF && equal_leaves) {
    nodes_.resize(parent + 1);
    node.children = 0;
  }
  nodes_[parent] = node;
}

void OctreeNodes::addInner(const VoxelStates& states, Part part, int level) {
  if (part.begin == part.end) return;
  if (level == 0) return addWithin(states[part.begin].second, 0, 0, 0, kBlockSide);
  const int shift = 3 * (level - 1);
  addParent([&](unsigned child) {
    const size_t begin = part.begin;
    while (part.begin < part.end && (states[part.begin].first >> shift & 7) == child) ++part.begin;
    addInner(states, {begin, part.begin}, level - 1);
  });
}

void OctreeNodes::addWithin(const StateBlock& block, size_t x, size_t y, size_t z, size_t side) {
  if (side == 1) {
    const VoxelState state = block[(z * kBlockSide + y) * kBlockSide + x];
    if (state != 0) nodes_.push_back({valueOf(state), 0});
    return;
  }
  const size_t half = side / 2;
  addParent([&](unsigned child) {
    addWithin(block, x + (child & 1) * half, y + (child >> 1 & 1) * half, z + (child >> 2) * half,
              half);
  });
}

void writeLogOdds(const VoxelStates& states, double resolution_m, const std::string& comment,
                  std::ostream& file) {
  const OctreeNodes tree(states, false);
  writeHeader("file", tree.nodes().size(), resolution_m, comment, file);
  for (const OctreeNodes::Node& node : tree.nodes()) {
    write(logOdds(node.value), file);
    write(node.children, file);
  }
}

void writeBonsai(const VoxelStates& states, double resolution_m, const std::string& comment,
                 std::ostream& file) {
  const OctreeNodes tree(states, true);
  const auto& nodes = tree.nodes();
  writeHeader("binary file", nodes.size(), resolution_m, comment, file);
  for (size_t i = 0; i < nodes.size(); ++i)
    if (nodes[i].children != 0) write(bonsaiBits(nodes, i), file);
}

}  // namespace lamp
