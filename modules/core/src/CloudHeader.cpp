#include "lamp/core/CloudHeader.h"

#include "lamp/core/Csv.h"

namespace lamp {

namespace {

bool isFloat(const CloudField& field) {
  return field.scalar == CloudScalar::kFloat;
}

}  // namespace

std::string plyHeader(const CloudLayout& layout) {
  std::string text = "ply\nformat binary_little_endian 1.0\n";
  for (const std::string& comment : layout.comments) text += "comment " + comment + "\n";
  text += "element vertex " + std::to_string(layout.points) + "\n";
  for (const CloudField& field : layout.fields)
    text += std::string("property ") + (isFloat(field) ? "float " : "uchar ") + field.name + "\n";
  return text + "end_header\n";
}

std::string pcdHeader(const CloudLayout& layout) {
  std::string text, names, sizes, types, counts;
  for (const std::string& comment : layout.comments) text += "# " + comment + "\n";
  for (const CloudField& field : layout.fields) {
    names += " " + field.name;
    sizes += isFloat(field) ? " 4" : " 1";
    types += isFloat(field) ? " F" : " U";
    counts += " 1";
  }
  const std::string points = std::to_string(layout.points);
  return text + "VERSION 0.7\nFIELDS" + names + "\nSIZE" + sizes + "\nTYPE" + types + "\nCOUNT" +
         counts + "\nWIDTH " + points + "\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS " + points +
         "\nDATA binary\n";
}

std::string offsetComment(const Eigen::Vector3d& offset) {
  if (offset.isZero(0)) return "";
  std::string text = "offset";
  for (const double coordinate : offset) text += " " + formatFixed(coordinate, 0);
  return text;
}

}  // namespace lamp
