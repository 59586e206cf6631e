#include "G2oFile.h"

#include <cmath>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace lamp::test {

namespace {

std::vector<double> numbers(std::istream& in, size_t count) {
  std::vector<double> values(count);
  for (double& value : values) in >> value;
  if (!in) throw std::runtime_error("too few numbers in a line of a g2o file");
  return values;
}

Pose3 pose(std::istream& in) {
  const std::vector<double> v = numbers(in, 7);
  const Eigen::Quaterniond rotation(v[6], v[3], v[4], v[5]);
  if (std::abs(rotation.norm() - 1) > 1e-9) throw std::runtime_error("no unit quaternion");
  return Eigen::Translation3d(v[0], v[1], v[2]) * rotation;
}

/** The upper triangle, row by row. */
Matrix6d information(std::istream& in) {
  const std::vector<double> v = numbers(in, 21);
  Matrix6d matrix;
  size_t next = 0;
  for (int row = 0; row < 6; ++row)
    for (int column = row; column < 6; ++column)
      matrix(row, column) = matrix(column, row) = v[next++];
  return matrix;
}

}  // namespace

G2oFile G2oFile::read(const std::string& path) {
  std::ifstream file(path);
  G2oFile graph;
  for (std::string line; std::getline(file, line);) {
    std::istringstream in(line);
    std::string tag;
    int id = 0, to = 0;
    in >> tag >> id;
    if (tag == "VERTEX_SE3:QUAT") {
      graph.vertices[id] = pose(in);
    } else if (tag == "EDGE_SE3:QUAT") {
      in >> to;
      const Pose3 from_T_to = pose(in);
      graph.edges.push_back({id, to, from_T_to, information(in)});
    } else if (tag == "FIX") {
      graph.fixed.insert(id);
    } else {
      throw std::runtime_error(path + ": no line of a 3D pose graph: " + line);
    }
  }
  return graph;
}

}  // namespace lamp::test
