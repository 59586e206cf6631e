#pragma once

#include <octomap/OcTree.h>

#include <memory>
#include <string>

namespace lamp {

enum class Cell { kUnknown, kFree, kOccupied };

inline Cell cellAt(const octomap::OcTree& tree, double x, double y, double z) {
  const octomap::OcTreeNode* node = tree.search(x, y, z);
  if (!node) return Cell::kUnknown;
  return tree.isNodeOccupied(node) ? Cell::kOccupied : Cell::kFree;
}

inline std::unique_ptr<octomap::OcTree> readLogOdds(const std::string& path) {
  std::unique_ptr<octomap::AbstractOcTree> tree(octomap::AbstractOcTree::read(path));
  auto* occupancy = dynamic_cast<octomap::OcTree*>(tree.get());
  if (occupancy) tree.release();
  return std::unique_ptr<octomap::OcTree>(occupancy);
}

}  // namespace lamp
