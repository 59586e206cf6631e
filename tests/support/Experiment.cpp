#include "Experiment.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "lamp/core/Files.h"
#include "lamp/core/Trajectory.h"

namespace lamp::test {

nlohmann::json FinishedRun::summary() const {
  return nlohmann::json::parse(readTextFile(folder_.summary()));
}

std::vector<StampedPose> FinishedRun::trajectory(const std::string& robot) const {
  return readTum(folder_.trajectory(robot));
}

std::vector<StampedPose> FinishedRun::odometry(const std::string& robot) const {
  return readTum(folder_.odometryTrajectory(robot));
}

std::vector<StampedPose> FinishedRun::keyNodes(const std::string& robot) const {
  return readTum(folder_.keyNodeTrajectory(robot));
}

Pose3 FinishedRun::startOf(const std::string& b, const std::string& a) const {
  return keyNodes(a).front().pose.inverse() * keyNodes(b).front().pose;
}

bool FinishedRun::has(const std::string& file) const {
  return std::filesystem::exists(folder_.root() + "/" + file);
}

std::map<std::string, std::string> FinishedRun::files() const {
  namespace fs = std::filesystem;
  std::map<std::string, std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder_.root())) {
    const std::string name = fs::relative(entry.path(), folder_.root()).string();
    if (entry.is_regular_file() && name != "timings.json")
      files[name] = readFile(entry.path().string());
  }
  return files;
}

void expectSameFiles(const FinishedRun& one, const FinishedRun& two) {
  const auto files_of_one = one.files(), files_of_two = two.files();
  ASSERT_EQ(files_of_one.size(), files_of_two.size());
  for (const auto& [name, content] : files_of_one) {
    const auto found = files_of_two.find(name);
    ASSERT_NE(found, files_of_two.end()) << name;
    EXPECT_TRUE(found->second == content) << name << " differs";
  }
}

std::vector<LoopEnds> inlierLoops(const CsvTable& loops) {
  const size_t verdict = loops.column("verdict");
  const size_t from = loops.column("from"), to = loops.column("to");
  std::vector<LoopEnds> ends;
  for (const auto& row : loops.rows)
    if (row[verdict] == "inlier") ends.emplace_back(row[from], row[to]);
  return ends;
}

std::string robotOf(const std::string& key_node) {
  return key_node.substr(0, key_node.find(':'));
}

int indexOf(const std::string& key_node) {
  return std::stoi(key_node.substr(key_node.find(':') + 1));
}

std::string Experiment::rawlog(const std::string& name, const Objects& objects) const {
  return file(name, bytesOf(objects));
}

std::string Experiment::file(const std::string& name, const std::string& content) const {
  std::filesystem::create_directories(std::filesystem::path(folder_ / name).parent_path());
  writeFile(folder_ / name, content);
  return folder_ / name;
}

LampResult Experiment::run(const std::vector<std::string>& arguments,
                           const std::string& name) const {
  std::vector<std::string> words = arguments;
  words.insert(words.end(), {"--out", folder_ / name});
  return runLamp(words);
}

std::string iniFor3d(const std::string& exporters, const std::string& more) {
  return "[pipeline]\nexporters = " + exporters + R"(
[frontend]
key_node_distance_m = 1
initial_leaf_m = 0.15
max_range_m = 40
)" + more;
}

std::string iniForPlanar(const std::string& exporters) {
  return "[pipeline]\nexporters = " + exporters + R"(
[frontend]
key_node_distance_m = 1
max_range_m = 40
initial_leaf_m = 0.03
min_leaf_m = 0.03
[registration]
normal_neighbors = 6
)";
}

std::string startSection(const std::string& robot, const Pose3& world_T_base) {
  Vector6d pose = yawPitchRollFromPose(world_T_base);
  pose.tail<3>() *= 180.0 / M_PI;
  std::string numbers;
  for (const double number : pose) numbers += (numbers.empty() ? "" : " ") + formatDouble(number);
  return "[robot." + robot + "]\nstart_pose = [" + numbers + "]\n";
}

}  // namespace lamp::test
