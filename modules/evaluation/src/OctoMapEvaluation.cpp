#include "lamp/evaluation/OctoMapEvaluation.h"

#include <octomap/OcTree.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <memory>
#include <sstream>
#include <stdexcept>
#include <unordered_set>

#include "lamp/core/KdTree.h"
#include "lamp/evaluation/FreeSpace.h"

namespace lamp::evaluation {

namespace {

constexpr double kWatertightVoxel = 0.2;  ///< metres; samples are 0.1 m apart

/** What OcTree::readBinary() does, which also prints to the terminal, and takes a file that ends
 * early for a smaller tree. \return null if the file is none or damaged. */
std::unique_ptr<octomap::OcTree> readBonsai(std::istream& file) {
  std::string line, keyword, id;
  size_t size = 0;
  double resolution = 0;
  while (std::getline(file, line) && line != "data") {
    std::istringstream words(line);
    words >> keyword;
    if (keyword == "id") words >> id;
    if (keyword == "size") words >> size;
    if (keyword == "res") words >> resolution;
  }
  if (!file || id != "OcTree" || size == 0 || !(resolution > 0)) return nullptr;
  auto tree = std::make_unique<octomap::OcTree>(resolution);
  tree->readBinaryData(file);
  const bool complete = file && tree->calcNumNodes() == size;
  return complete ? std::move(tree) : nullptr;
}

std::unique_ptr<octomap::OcTree> readLogOdds(std::istream& file) {
  std::unique_ptr<octomap::AbstractOcTree> any(octomap::AbstractOcTree::read(file));
  auto* tree = dynamic_cast<octomap::OcTree*>(any.get());
  if (tree) any.release();
  return std::unique_ptr<octomap::OcTree>(tree);
}

std::unique_ptr<octomap::OcTree> readTree(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  const bool binary = std::filesystem::path(path).extension() == ".bt";
  auto tree = binary ? readBonsai(file) : readLogOdds(file);
  if (!tree || tree->size() == 0)
    throw std::runtime_error("'" + path + "' is not an OctoMap, or is empty or damaged");
  return tree;
}

/** The offset from the world in a line `# offset X Y Z`, which OctoMap passes over. */
Eigen::Vector3d offsetOf(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::string line, hash, keyword;
  while (std::getline(file, line) && line != "data") {
    std::istringstream words(line);
    Eigen::Vector3d offset;
    if (words >> hash >> keyword >> offset.x() >> offset.y() >> offset.z() && hash == "#" &&
        keyword == "offset")
      return offset;
  }
  return Eigen::Vector3d::Zero();
}

/** Asks the octree about places in the frame of the true surface. */
class Inquiry {
 public:
  Inquiry(const octomap::OcTree& tree, const Pose3& surface_T_map)
      : tree_(tree), map_T_surface_(surface_T_map.inverse()) {}

  octomap::point3d inMap(const Eigen::Vector3d& p) const {
    const Eigen::Vector3f q = (map_T_surface_ * p).cast<float>();
    return {q.x(), q.y(), q.z()};
  }
  void count(const octomap::point3d& p, OctoMapCounts& counts) const {
    const octomap::OcTreeNode* node = tree_.search(p);
    ++(!node ? counts.unknown : tree_.isNodeOccupied(node) ? counts.occupied : counts.free);
  }
  void count(const Eigen::Vector3d& p, OctoMapCounts& counts) const { count(inMap(p), counts); }

 private:
  const octomap::OcTree& tree_;
  const Pose3 map_T_surface_;
};

/** Each voxel of the octree that holds one of the points counts once. */
OctoMapCounts voxelsWith(const std::vector<Eigen::Vector3f>& points, const octomap::OcTree& tree,
                         const Inquiry& inquiry) {
  OctoMapCounts counts;
  std::unordered_set<octomap::OcTreeKey, octomap::OcTreeKey::KeyHash> voxels;
  for (const Eigen::Vector3f& point : points) {
    const octomap::point3d p = inquiry.inMap(point.cast<double>());
    octomap::OcTreeKey key;
    if (!tree.coordToKeyChecked(p, key) || !voxels.insert(key).second) continue;
    inquiry.count(p, counts);
  }
  return counts;
}

std::vector<Eigen::Vector3f> seenOf(const SurfaceSamples& surface) {
  std::vector<Eigen::Vector3f> seen;
  for (size_t i = 0; i < surface.points.size(); ++i)
    if (surface.seen[i]) seen.push_back(surface.points[i]);
  return seen;
}

/** Samples that face up, within 0.5 m beside a true position and at most 2 m below it. */
OctoMapCounts drivenFloor(const Inquiry& inquiry, const SurfaceSamples& surface,
                          const std::vector<Eigen::Vector3f>& positions) {
  constexpr float kBeside = 0.5f, kBelow = 2.0f, kUpward = 0.5f;
  constexpr float kAbove = 0.4f;  // a base near the ground may lie below its samples
  std::vector<Eigen::Vector3f> on_plane = positions;
  for (Eigen::Vector3f& p : on_plane) p.z() = 0;
  const KdTree tree(on_plane);
  OctoMapCounts counts;
  for (size_t i = 0; i < surface.points.size(); ++i) {
    const Eigen::Vector3f& p = surface.points[i];
    if (!surface.seen[i] || surface.normals[i].z() <= kUpward) continue;
    if (tree.anyWithin({p.x(), p.y(), 0}, kBeside, [&](size_t j) {
          const float height = positions[j].z() - p.z();
          return height >= -kAbove && height <= kBelow;
        }))
      inquiry.count(p.cast<double>(), counts);
  }
  return counts;
}

}  // namespace

OctoMapEvaluation evaluateOctoMap(const std::string& path, const Pose3& surface_T_world,
                                  const SurfaceSamples& surface,
                                  const std::vector<Eigen::Vector3f>& positions,
                                  const std::vector<Eigen::Vector3f>& moving) {
  const auto tree = readTree(path);
  const Inquiry inquiry(*tree, surface_T_world * Eigen::Translation3d(offsetOf(path)));
  OctoMapEvaluation evaluation;
  evaluation.resolution_m = tree->getResolution();
  evaluation.free_resolution_m = std::max(kWatertightVoxel, evaluation.resolution_m);
  evaluation.surface = voxelsWith(seenOf(surface), *tree, inquiry);
  evaluation.moving = voxelsWith(moving, *tree, inquiry);
  evaluation.driven_floor = drivenFloor(inquiry, surface, positions);
  try {
    forEachFreeVoxel(surface, positions, evaluation.free_resolution_m,
                     [&](const Eigen::Vector3d& p) { inquiry.count(p, evaluation.free_space); });
  } catch (const std::runtime_error& error) {
    evaluation.no_free_space = error.what();
  }
  return evaluation;
}

}  // namespace lamp::evaluation
