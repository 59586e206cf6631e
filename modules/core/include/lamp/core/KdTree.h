#pragma once

#include <Eigen/Core>
#include <functional>
#include <memory>
#include <vector>

namespace lamp {

/** Nearest neighbours in a fixed set of points. Safe to query from many threads. */
class KdTree {
 public:
  /** \param points must outlive the tree and stay where they are; may be empty. */
  explicit KdTree(const std::vector<Eigen::Vector3f>& points);
  ~KdTree();
  KdTree(KdTree&&) noexcept;
  KdTree& operator=(KdTree&&) noexcept;

  static constexpr size_t kNone = static_cast<size_t>(-1);
  /** Index of the nearest point within `max_distance`, or kNone.
   *  \param[out] squared_distance metres², unchanged if there is none. */
  size_t nearest(const Eigen::Vector3f& query, float max_distance, float& squared_distance) const;
  /** Indices of the k nearest points, nearest first; fewer if there are fewer points. */
  void nearest(const Eigen::Vector3f& query, size_t k, std::vector<uint32_t>& indices) const;
  /** Whether a point nearer than `distance` has the property. Stops at the first that has. */
  bool anyWithin(const Eigen::Vector3f& query, float distance,
                 const std::function<bool(size_t)>& property) const;

 private:
  struct Index;
  std::unique_ptr<Index> index_;
};

}  // namespace lamp
