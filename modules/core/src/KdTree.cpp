#include "lamp/core/KdTree.h"

#include <nanoflann.hpp>

namespace lamp {

namespace {

struct Adaptor {
  const std::vector<Eigen::Vector3f>& points;
  size_t kdtree_get_point_count() const { return points.size(); }
  float kdtree_get_pt(size_t i, size_t axis) const {
    return points[i][static_cast<Eigen::Index>(axis)];
  }
  template <class Box>
  bool kdtree_get_bbox(Box&) const {
    return false;
  }
};

using Tree = nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<float, Adaptor>,
                                                 Adaptor, 3, uint32_t>;
constexpr size_t kLeafSize = 10;

/** The nearest point within a distance: a bound from the start prunes most of the tree for points
 * without a partner. */
class NearestPoint {
 public:
  using DistanceType = float;  ///< nanoflann asks for this name
  explicit NearestPoint(float distance) : squared_(distance * distance) {}

  bool addPoint(float squared_distance, uint32_t index) {
    if (squared_distance < squared_) {
      squared_ = squared_distance;
      index_ = index;
    }
    return true;
  }
  float worstDist() const { return squared_; }
  bool full() const { return true; }
  size_t index() const { return index_; }

 private:
  float squared_;
  size_t index_ = KdTree::kNone;
};

/** Ends the search at the first point with the property. */
class FirstWithProperty {
 public:
  using DistanceType = float;  ///< nanoflann asks for this name
  FirstWithProperty(float distance, const std::function<bool(size_t)>& property)
      : squared_(distance * distance), property_(property) {}

  bool addPoint(float squared_distance, uint32_t index) {
    found_ = squared_distance < squared_ && property_(index);
    return !found_;
  }
  float worstDist() const { return squared_; }
  bool full() const { return true; }
  bool found() const { return found_; }

 private:
  const float squared_;
  const std::function<bool(size_t)>& property_;
  bool found_ = false;
};

}  // namespace

struct KdTree::Index {
  explicit Index(const std::vector<Eigen::Vector3f>& points)
      : adaptor{points}, tree(3, adaptor, {kLeafSize}) {}
  Adaptor adaptor;
  Tree tree;
};

KdTree::KdTree(const std::vector<Eigen::Vector3f>& points)
    : index_(points.empty() ? nullptr : std::make_unique<Index>(points)) {}
KdTree::~KdTree() = default;
KdTree::KdTree(KdTree&&) noexcept = default;
KdTree& KdTree::operator=(KdTree&&) noexcept = default;

size_t KdTree::nearest(const Eigen::Vector3f& query, float max_distance,
                       float& squared_distance) const {
  if (!index_) return kNone;
  NearestPoint result(max_distance);
  index_->tree.findNeighbors(result, query.data(), {});
  if (result.index() != kNone) squared_distance = result.worstDist();
  return result.index();
}

void KdTree::nearest(const Eigen::Vector3f& query, size_t k, std::vector<uint32_t>& indices) const {
  indices.resize(index_ ? k : 0);
  if (!index_) return;
  thread_local std::vector<float> squared;
  squared.resize(k);
  indices.resize(index_->tree.knnSearch(query.data(), k, indices.data(), squared.data()));
}

bool KdTree::anyWithin(const Eigen::Vector3f& query, float distance,
                       const std::function<bool(size_t)>& property) const {
  if (!index_) return false;
  FirstWithProperty result(distance, property);
  index_->tree.findNeighbors(result, query.data(), {});
  return result.found();
}

}  // namespace lamp
