#include "rejection/FrameAverages.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "lamp/core/ChiSquare.h"
#include "robust/TruncatedLeastSquares.h"
#include "solver/Information.h"

namespace lamp {

namespace {

constexpr double kInlierProbability = 0.9999;
/** How many measurements are tried as a start. */
constexpr size_t kMaxStarts = 200;
constexpr double kMuStep = 1.6;
constexpr int kMaxRounds = 100;
/** m² and rad²: after a drive, no loop closure knows the frames better than such priors do. */
constexpr double kSurePrior = 1e-3;

/** What one loop closure says about a frame. */
struct Measurement {
  EdgeIndex loop;
  KeyNodeId a, b;  ///< its key nodes
  Pose3 a_T_b;
  Matrix6d information;
  double threshold;  ///< the largest squared distance of an inlier

  /** In units of the threshold. */
  double distance2(const Pose3& pose) const {
    const Vector6d error = logSE3(a_T_b.inverse() * pose);
    return error.dot(information * error) / threshold;
  }
};

Measurement measurement(const OdometryChains& chains, EdgeIndex e, const Edge& edge, bool planar) {
  const Matrix6d of_loop = boundedCovariance(edge.information, planar);
  const RelativePose from = chains.fromFirst(edge.from), to = chains.fromFirst(edge.to);
  const Pose3 to_T_first = to.a_T_b.inverse();
  const Matrix6d at_to = composeCovariance(from.covariance, edge.from_T_to, of_loop);
  // (T · Exp(d))⁻¹ = T⁻¹ · Exp(-Ad(T) d)
  const Matrix6d Ad = adjoint(to.a_T_b);
  const Matrix6d covariance =
      composeCovariance(at_to, to_T_first, Ad * to.covariance * Ad.transpose());
  const int rank = std::max(1, informationRank(edge.information, planar));
  Measurement result{e,
                     edge.from,
                     edge.to,
                     from.a_T_b * edge.from_T_to * to_T_first,
                     covariance.inverse(),
                     chiSquareQuantile(kInlierProbability, rank)};
  if (chains.chain(edge.from) < chains.chain(edge.to)) return result;
  const Matrix6d back = adjoint(result.a_T_b.inverse());
  return {e,
          edge.to,
          edge.from,
          result.a_T_b.inverse(),
          back.transpose() * result.information * back,
          result.threshold};
}

/** Gauss-Newton for the weighted mean. */
Pose3 mean(const std::vector<Measurement>& measurements, const std::vector<double>& weights,
           Pose3 pose, Matrix6d* information) {
  constexpr int kMaxIterations = 10;
  constexpr double kSmallStep = 1e-9;
  for (int iteration = 0; iteration < kMaxIterations; ++iteration) {
    Matrix6d H = Matrix6d::Zero();
    Vector6d gradient = Vector6d::Zero();
    for (size_t i = 0; i < measurements.size(); ++i) {
      if (!(weights[i] > 0)) continue;
      const Vector6d error = logSE3(measurements[i].a_T_b.inverse() * pose);
      const Matrix6d J = rightJacobianInverse(error);
      const Matrix6d weighted = weights[i] * J.transpose() * measurements[i].information;
      H += weighted * J;
      gradient += weighted * error;
    }
    *information = H;
    const Vector6d step = -H.ldlt().solve(gradient);
    pose = normalized(pose * expSE3(step));
    if (step.norm() < kSmallStep) break;
  }
  return pose;
}

/** The measurement nearest to most others. */
Pose3 start(const std::vector<Measurement>& measurements) {
  const size_t stride = measurements.size() / kMaxStarts + 1;
  Pose3 best = measurements[0].a_T_b;
  double least = static_cast<double>(measurements.size());
  for (size_t i = 0; i < measurements.size(); i += stride) {
    double cost = 0;
    for (const Measurement& other : measurements)
      cost += std::min(1.0, other.distance2(measurements[i].a_T_b));
    if (cost >= least) continue;
    least = cost;
    best = measurements[i].a_T_b;
  }
  return best;
}

/** Counts loops that agree and see different places: those of one key node may all be wrong in the
 * same way. */
size_t countAgreeing(const std::vector<Measurement>& measurements, const Pose3& pose) {
  std::set<KeyNodeId> of_a, of_b;
  for (const Measurement& m : measurements) {
    if (!(m.distance2(pose) <= 1.0)) continue;
    of_a.insert(m.a);
    of_b.insert(m.b);
  }
  return std::min(of_a.size(), of_b.size());
}

std::vector<EdgeIndex> agreeingLoops(const std::vector<Measurement>& measurements,
                                     const Pose3& pose) {
  std::vector<EdgeIndex> loops;
  for (const Measurement& m : measurements)
    if (m.distance2(pose) <= 1.0) loops.push_back(m.loop);
  return loops;
}

FrameAverage average(int a, int b, const std::vector<Measurement>& measurements) {
  TruncatedLeastSquares loss;
  Pose3 pose = start(measurements);
  Matrix6d information = Matrix6d::Zero();
  std::vector<double> distances2(measurements.size()), weights(measurements.size());
  const auto weigh = [&] {
    for (size_t i = 0; i < measurements.size(); ++i) {
      distances2[i] = measurements[i].distance2(pose);
      weights[i] = loss.weight(distances2[i]);
    }
  };
  for (size_t i = 0; i < measurements.size(); ++i) distances2[i] = measurements[i].distance2(pose);
  loss.start(std::max(2.0, *std::max_element(distances2.begin(), distances2.end())));
  for (int round = 0; round < kMaxRounds; ++round) {
    weigh();
    pose = mean(measurements, weights, pose, &information);
    if (loss.exactFor(distances2)) break;
    loss.sharpen(kMuStep);
  }
  return {a,
          b,
          {pose, information.inverse()},
          measurements.size(),
          agreeingLoops(measurements, pose),
          countAgreeing(measurements, pose)};
}

bool surelyRelated(const OdometryChains& chains, int a, int b) {
  const auto surely = [&](int chain) {
    return chains.hasPrior(chain) && chains.prior(chain).covariance.trace() < kSurePrior;
  };
  return surely(a) && surely(b);
}

}  // namespace

std::vector<FrameAverage> frameAverages(const PoseGraph& graph, const OdometryChains& chains,
                                        const std::vector<bool>& admitted) {
  std::map<std::pair<int, int>, std::vector<Measurement>> by_pair;
  const bool planar = graph.planar();
  for (EdgeIndex e = 0; e < graph.edges().size(); ++e) {
    const Edge& edge = graph.edges()[e];
    if (edge.type != EdgeType::kLoopClosure || !admitted[e]) continue;
    const int from = chains.chain(edge.from), to = chains.chain(edge.to);
    if (from != to && !surelyRelated(chains, from, to))
      by_pair[std::minmax(from, to)].push_back(measurement(chains, e, edge, planar));
  }
  std::vector<FrameAverage> averages;
  for (const auto& [pair, measurements] : by_pair)
    averages.push_back(average(pair.first, pair.second, measurements));
  return averages;
}

}  // namespace lamp
