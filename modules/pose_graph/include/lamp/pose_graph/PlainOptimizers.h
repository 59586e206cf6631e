#pragma once

#include "lamp/pose_graph/Optimizer.h"
#include "lamp/pose_graph/SolverOptions.h"

namespace lamp {

struct PlainOptions {
  std::string start = "estimate";
  SolverOptions solve;

  void visit(OptionVisitor& v);
};

/** Least squares over odometry, priors and all admitted loop closures, which come out as inliers of
 * weight 1. Priors hold the components that they reach; every other component is held at its first
 * key node. A planar graph is solved in x, y, yaw. */
class PlainOptimizer : public Optimizer {
  DEFINE_VIRTUAL_MRPT_OBJECT(PlainOptimizer)

 public:
  using Optimizer::optimize;
  void visit(OptionVisitor& options) override { options_.visit(options); }
  /** \throws std::runtime_error if the estimate of a node is not finite. */
  OptimizationResult optimize(const PoseGraph& graph, const std::vector<bool>& admitted) override;

 protected:
  explicit PlainOptimizer(const PlainOptions& options) : options_(options) {}

 private:
  /** One of solverNames(). */
  virtual std::string solver() const = 0;

  PlainOptions options_;
};

/** Levenberg-Marquardt with our own sparse block Cholesky factorisation (docs/pose_graph.md). */
class Lm : public PlainOptimizer {
  DEFINE_MRPT_OBJECT(Lm, lamp)

 public:
  explicit Lm(const PlainOptions& options = {}) : PlainOptimizer(options) {}

 private:
  std::string solver() const override { return "Lm"; }
};

/** Gauss-Newton with the same linear algebra: fewer safeguards, for graphs with good estimates. The
 * result is not usable if the normal equations are singular or the cost has grown. */
class Gn : public PlainOptimizer {
  DEFINE_MRPT_OBJECT(Gn, lamp)

 public:
  explicit Gn(const PlainOptions& options = {}) : PlainOptimizer(options) {}

 private:
  std::string solver() const override { return "Gn"; }
};

/** Ceres' Levenberg-Marquardt: slower, the reference for tests. */
class CeresLm : public PlainOptimizer {
  DEFINE_MRPT_OBJECT(CeresLm, lamp)

 public:
  explicit CeresLm(const PlainOptions& options = {}) : PlainOptimizer(options) {}

 private:
  std::string solver() const override { return "CeresLm"; }
};

}  // namespace lamp
