#include "lamp/scans/Icp.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "IcpLinearization.h"

namespace lamp {

namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Eigen::Vector3f;

constexpr size_t kMinMatches = 10;
/** About how many points take part in the coarse iterations, and in the fine ones. */
constexpr size_t kCoarsePoints = 500, kFinePoints = 1500;
/** A step smaller than this many tolerances ends the coarse iterations. */
constexpr double kCoarseTolerance = 10;

/** The pairs of an alignment as it goes on: the partner of the last iteration bounds the search for
 * the next one. */
class Matcher {
 public:
  Matcher(const PreparedScan& source, const PreparedScan& target)
      : source_(source), target_(target), partners_(source.own().size(), KdTree::kNone) {}

  /** Every `stride`-th source point with its nearest target point within `max_distance`. */
  IcpNormalEquations linearize(const Pose3& T, const Vector3d& pivot, double max_distance,
                               size_t stride, Linearization sum) {
    const Eigen::Isometry3f Tf = T.cast<float>();
    for (size_t k = 0; k < source_.own().size(); k += stride) {
      const uint32_t i = source_.own()[k];
      const Vector3f p = Tf * source_.points()[i];
      const size_t j = partner(k, p, static_cast<float>(max_distance));
      if (j == KdTree::kNone || target_.normals()[j].isZero()) continue;
      sum.add(p.cast<double>() - pivot, (p - target_.points()[j]).cast<double>(),
              target_.normals()[j].cast<double>(),
              (Tf.linear() * source_.normals()[i]).cast<double>());
    }
    return sum.result();
  }

 private:
  size_t partner(size_t k, const Vector3f& p, float max_distance) {
    float bound = max_distance, squared;
    size_t last = partners_[k];
    if (last != KdTree::kNone) {
      const float distance = (p - target_.points()[last]).norm();
      if (distance < max_distance)
        bound = distance;
      else
        last = KdTree::kNone;
    }
    const size_t nearer = target_.tree().nearest(p, bound, squared);
    return partners_[k] = nearer != KdTree::kNone ? nearer : last;
  }

  const PreparedScan& source_;
  const PreparedScan& target_;
  std::vector<size_t> partners_;
};

/** The options for scans whose points lie farther apart. */
IcpOptions scaled(IcpOptions options, double coarseness) {
  options.start_correspondence_m *= coarseness;
  options.correspondence_m *= coarseness;
  options.kernel_m *= coarseness;
  return options;
}

/** From coarse to fine: how far partners may lie apart, and how many points take part. */
class Schedule {
 public:
  Schedule(const IcpOptions& options, size_t points)
      : options_(options),
        distance_(std::max(options.start_correspondence_m, options.correspondence_m)),
        stride_(std::max<size_t>(1, points / kCoarsePoints)),
        fine_stride_(std::max<size_t>(1, points / kFinePoints)) {}

  double distance() const { return distance_; }
  size_t stride() const { return stride_; }
  /** Narrows with the search distance: coarse matches still pull, fine ones decide. */
  double kernel() const { return options_.kernel_m * distance_ / options_.correspondence_m; }

  /** Goes on to the next iteration. \return whether the last step was small enough for none. */
  bool endsAfter(const Vector6d& step) {
    const double share_of_tolerance =
        std::max(step.head<3>().norm() / options_.translation_tolerance_m,
                 step.tail<3>().norm() / (options_.rotation_tolerance_deg * M_PI / 180.0));
    if (distance_ > options_.correspondence_m)
      distance_ = std::max(options_.correspondence_m, distance_ * options_.shrink_factor);
    else if (stride_ == fine_stride_)
      return share_of_tolerance < 1;
    else if (share_of_tolerance < kCoarseTolerance)
      stride_ = fine_stride_;
    return false;
  }

 private:
  const IcpOptions options_;
  double distance_;
  size_t stride_;
  const size_t fine_stride_;
};

}  // namespace

void IcpOptions::visit(OptionVisitor& v) {
  v("max_iterations", max_iterations, "", "maximum number of Gauss-Newton iterations", {1});
  v("start_correspondence_m", start_correspondence_m, "m",
    "maximum correspondence distance in the first iteration", kPositive);
  v("correspondence_m", correspondence_m, "m",
    "maximum correspondence distance in the last iterations", kPositive);
  v("shrink_factor", shrink_factor, "",
    "factor applied to the correspondence distance after each iteration", {0.1, 0.99});
  v("kernel_m", kernel_m, "m",
    "residual at which a correspondence has lost three quarters of its weight", kPositive);
  v("plane_thickness", plane_thickness, "",
    "variance across a surface, as a fraction of that along it", {1e-6, 1});
  v("translation_tolerance_m", translation_tolerance_m, "m",
    "the iterations end with a smaller step", kPositive);
  v("rotation_tolerance_deg", rotation_tolerance_deg, "deg",
    "the iterations end with a smaller step", kPositive);
}

IcpResult icp(const PreparedScan& source, const PreparedScan& target, const Pose3& start,
              IcpMetric metric, const IcpOptions& given) {
  const IcpOptions options = scaled(given, coarseness(source, target));
  IcpResult result;
  result.target_T_source = start;
  const bool planar = source.planar() && target.planar();
  // Many points of the one may match the same few of the other: that says nothing of the pose.
  if (std::min(source.own().size(), target.size()) < kMinMatches) return result;
  Matcher matcher(source, target);
  Schedule schedule(options, source.own().size());
  while (!result.converged && result.iterations < options.max_iterations) {
    const Vector3d pivot = result.target_T_source * source.centroid();
    const IcpNormalEquations equations =
        matcher.linearize(result.target_T_source, pivot, schedule.distance(), schedule.stride(),
                          Linearization(metric, options.plane_thickness, schedule.kernel()));
    ++result.iterations;
    result.matches = equations.matches;
    if (equations.matches < kMinMatches) return result;
    const Vector6d step = solveStep(equations, planar);
    if (!step.allFinite()) return result;
    result.target_T_source = movedAbout(pivot, step, result.target_T_source);
    result.converged = schedule.endsAfter(step);
  }
  return result;
}

}  // namespace lamp
