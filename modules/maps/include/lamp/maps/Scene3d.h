#pragma once

#include <string>
#include <vector>

#include "lamp/maps/MapExporter.h"

namespace lamp {

struct Scene3dOptions {
  double voxel_m = 0.2;

  void visit(OptionVisitor& v) {
    v("voxel_m", voxel_m, "m", "voxel size of the points; each voxel keeps its first point",
      kPositive);
  }
};

/** `<stem>.3Dscene`: a mrpt::opengl::COpenGLScene for SceneViewer3D. Points coloured by height,
 * trajectories with a name and a corner in the robots' colours, accepted loop closures in green.
 * Frame of the map, metres; its offset from the world is a text in the scene. */
class Scene3d : public MapExporter {
  DEFINE_MRPT_OBJECT(Scene3d, lamp)

 public:
  Scene3d() = default;
  explicit Scene3d(const Scene3dOptions& options) : options_(options) {}

  void visit(OptionVisitor& options) override { options_.visit(options); }
  std::vector<std::string> exportMap(const ComponentMap& map, const std::string& stem) override;

 private:
  Scene3dOptions options_;
};

}  // namespace lamp
