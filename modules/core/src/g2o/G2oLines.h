#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "lamp/core/Geometry.h"

namespace lamp {

enum class G2oKind {
  kPose,
  kRelativePose,
  kPriorPose,
  kPriorPosition,
  kLandmark,
  kSighting,  ///< of a landmark from a pose
  kOffset,    ///< of a sensor, a parameter of other lines in space
  kFixed,
};

/** One kind of line: how many ids and numbers it has. */
struct G2oTag {
  const char* name;
  bool planar;
  G2oKind kind;
  size_t ids, numbers;
  bool parameter = false;  ///< one more id may follow the others: of an offset, or of a switch
};

/** A line of a g2o file, in our conventions. */
struct G2oLine {
  const G2oTag* tag;
  size_t number;  ///< from 1
  std::vector<uint64_t> ids;
  uint64_t parameter = 0;
  Pose3 pose = Pose3::Identity();               ///< positions: its translation
  Matrix6d information = Matrix6d::Identity();  ///< tangent space at the pose
  bool rounded = false;  ///< the file's information was indefinite, if only by its rounding

  bool is(G2oKind kind) const { return tag->kind == kind; }
};

struct G2oLines {
  std::string name;  ///< of the file
  std::vector<G2oLine> lines;
  std::map<std::string, size_t> skipped;  ///< lines with a tag that we do not know, by tag

  /** File, line, tag and ids. */
  std::string where(const G2oLine& line) const;
};

/** The lines that G2oFile.h tells of, each one right in itself.
 * \throws std::runtime_error naming the line. */
G2oLines parseG2oLines(const std::string& text, const std::string& name);

}  // namespace lamp
