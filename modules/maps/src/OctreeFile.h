#pragma once

#include <ostream>
#include <string>

#include "VoxelStates.h"

namespace lamp {

/** The nodes of an octree in the order in which OctoMap's files have them, each before its
 * children. Eight equal leaves are one. */
class OctreeNodes {
 public:
  struct Node {
    VoxelState value = 0;  ///< of a leaf its state, else the greatest of its children
    uint8_t children = 0;  ///< one bit for each that is there; of a leaf 0
  };

  /** \param sure_only keeps of each state only whether it is occupied or free. */
  OctreeNodes(const VoxelStates& states, bool sure_only);

  const std::vector<Node>& nodes() const { return nodes_; }

 private:
  struct Part {
    size_t begin, end;  ///< of the blocks
  };
  void addInner(const VoxelStates& states, Part part, int level);
  void addWithin(const StateBlock& block, size_t x, size_t y, size_t z, size_t side);
  template <class AddChild>
  void addParent(AddChild&& add_child);
  VoxelState valueOf(VoxelState state) const;

  bool sure_only_;
  std::vector<Node> nodes_;
};

/** Writes `.ot`: log-odds. \param comment a line for the header, or empty. */
void writeLogOdds(const VoxelStates& states, double resolution_m, const std::string& comment,
                  std::ostream& file);
/** Writes `.bt`: occupied or free. */
void writeBonsai(const VoxelStates& states, double resolution_m, const std::string& comment,
                 std::ostream& file);

}  // namespace lamp
