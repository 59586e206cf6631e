#include "lamp/evaluation/MapEvaluation.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_reduce.h>

#include <cmath>
#include <filesystem>
#include <sstream>
#include <stdexcept>

#include "lamp/core/CloudHeader.h"
#include "lamp/core/Colormap.h"
#include "lamp/core/Files.h"
#include "lamp/core/PlyVertices.h"

namespace lamp::evaluation {

namespace {

constexpr float kCompleteWithin = 0.2f;

std::vector<Eigen::Vector3f> readCloud(const std::string& path, const Pose3& surface_T_world) {
  std::vector<Eigen::Vector3f> points;
  const PlyVertices file(path);
  const Pose3 surface_T_map = surface_T_world * Eigen::Translation3d(file.offset());
  file.read({"x", "y", "z"}, [&](const double* v) {
    points.push_back((surface_T_map * Eigen::Vector3d(v[0], v[1], v[2])).cast<float>());
  });
  if (points.empty()) throw std::runtime_error("'" + path + "' holds no point");
  return points;
}

/** Share of the seen samples with a map point within reach. */
double completenessOf(const std::vector<Eigen::Vector3f>& map, const SurfaceSamples& samples) {
  struct Count {
    size_t seen = 0, met = 0;
  };
  using Range = tbb::blocked_range<size_t>;
  const KdTree tree(map);
  const Count count = tbb::parallel_reduce(
      Range(0, samples.points.size()), Count{},
      [&](const Range& range, Count sum) {
        for (size_t i = range.begin(); i < range.end(); ++i) {
          if (!samples.seen[i]) continue;
          float squared;
          ++sum.seen;
          if (tree.nearest(samples.points[i], kCompleteWithin, squared) != KdTree::kNone) ++sum.met;
        }
        return sum;
      },
      [](const Count& a, const Count& b) {
        return Count{a.seen + b.seen, a.met + b.met};
      });
  return static_cast<double>(count.met) / static_cast<double>(count.seen);
}

}  // namespace

MapEvaluation evaluateMap(const std::string& cloud, const Pose3& surface_T_world,
                          const TrueSurface& surface) {
  MapEvaluation map;
  map.name = std::filesystem::path(cloud).stem().string();
  map.world_p_origin = surface.samples().world_p_origin;
  map.points = readCloud(cloud, surface_T_world);
  map.errors_m.resize(map.points.size());
  tbb::parallel_for(size_t{0}, map.points.size(),
                    [&](size_t i) { map.errors_m[i] = surface.distance(map.points[i]); });
  map.accuracy_m = Statistics::of({map.errors_m.begin(), map.errors_m.end()});
  map.completeness = completenessOf(map.points, surface.samples());
  return map;
}

void writeErrorPly(const std::string& path, const MapEvaluation& map, double full_scale_m) {
  constexpr auto kByte = CloudScalar::kUint8;
  std::ostringstream comment;
  comment << "error in metres, coloured from 0 to " << full_scale_m;
  CloudLayout layout{
      {comment.str()},
      {{"x"}, {"y"}, {"z"}, {"red", kByte}, {"green", kByte}, {"blue", kByte}, {"error"}},
      map.points.size()};
  if (const std::string offset = offsetComment(map.world_p_origin); !offset.empty())
    layout.comments.push_back(offset);
  std::string bytes = plyHeader(layout);
  for (size_t i = 0; i < map.points.size(); ++i) {
    appendBytes(map.points[i], bytes);
    for (const uint8_t channel : viridis(map.errors_m[i] / full_scale_m))
      appendBytes(channel, bytes);
    appendBytes(map.errors_m[i], bytes);
  }
  writeBinaryFile(path, [&](std::ostream& file) {
    file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  });
}

double errorScale(const MapEvaluation& map) {
  constexpr double kSmallest = 0.1, kRounding = 1e-9;
  const double least = std::max(kSmallest, map.accuracy_m.p95);
  const double decade = std::pow(10.0, std::floor(std::log10(least) + kRounding));
  for (const double digit : {1.0, 2.0, 5.0})
    if (digit * decade >= least * (1 - kRounding)) return digit * decade;
  return 10 * decade;
}

}  // namespace lamp::evaluation
