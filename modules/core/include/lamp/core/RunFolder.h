#pragma once

#include <memory>
#include <string>

namespace lamp {

/** Paths of a run folder (docs/run-folder.md). All readers and writers get them from here. */
class RunFolder {
 public:
  explicit RunFolder(std::string root) : root_(std::move(root)) {}

  /** Makes the folder for a new run and locks it while the result or a copy of it lives.
   * \throws std::runtime_error if it holds anything already, another program has locked it, or it
   *  cannot be written. */
  static RunFolder create(const std::string& root);
  /** Makes the subfolders. Not before there is something to write: a run that fails early leaves an
   * empty folder, which the next attempt may use. */
  void createSubfolders() const;

  const std::string& root() const { return root_; }
  std::string config() const { return root_ + "/config.ini"; }
  std::string summary() const { return root_ + "/summary.json"; }
  std::string timings() const { return root_ + "/timings.json"; }
  std::string loops() const { return root_ + "/loops.csv"; }
  std::string verdicts() const { return root_ + "/verdicts.csv"; }
  std::string actions() const { return root_ + "/actions.csv"; }
  std::string artifacts() const { return root_ + "/artifacts.csv"; }
  std::string graphG2o() const { return root_ + "/graph.g2o"; }
  std::string graphMrpt() const { return root_ + "/graph.graph"; }
  std::string graphIds() const { return root_ + "/graph_ids.csv"; }
  std::string trajectory(const std::string& robot) const;
  std::string keyNodeTrajectory(const std::string& robot) const;
  std::string odometryTrajectory(const std::string& robot) const;
  std::string keyNodes(const std::string& robot) const;
  /** Path without extension: `maps/map` for the largest component (rank 0), `maps/map_2` for the
   * next. */
  std::string mapStem(size_t component_rank) const;

 private:
  std::string root_;
  std::shared_ptr<const void> lock_;
};

}  // namespace lamp
