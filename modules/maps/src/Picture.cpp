#include "lamp/maps/Picture.h"

#include <algorithm>

#include "DensityImage.h"
#include "Legend.h"
#include "LinePen.h"
#include "MapPoints.h"
#include "Png.h"
#include "TopView.h"

IMPLEMENTS_MRPT_OBJECT(Picture, lamp::MapExporter, lamp)

namespace lamp {

namespace {

constexpr int kMargin_px = 20;
constexpr int kLeastWidth_px = 760;  ///< room for the legend
constexpr double kTrack_px = 2.6, kHalo_px = 5.0, kLoop_px = 1.5;
constexpr double kLoopOpacity = 0.85;
constexpr double kStartRadius_px = 6.0;
constexpr Color kWhite{255, 255, 255};

Color colorOf(Verdict verdict) {
  return verdict == Verdict::kInlier    ? kAcceptedColor
         : verdict == Verdict::kOutlier ? kRejectedColor
                                        : kPendingColor;
}

void drawPoints(const ComponentMap& map, const TopView& view, bool tint, mrpt::img::CImage& image,
                int x0, int y0) {
  DensityImage density(view);
  forEachPoint(map, [&](const MapKeyNode& key_node, size_t, const Eigen::Vector3d& p) {
    density.add(p, robotColor(key_node.id.robot));
  });
  density.draw(image, x0, y0, tint);
}

void drawLoops(const ComponentMap& map, const TopView& view, Verdict verdict, LinePen& pen) {
  for (const MapLoop& loop : map.loops)
    if (loop.verdict == verdict)
      pen.line(view.toPixel(loop.from), view.toPixel(loop.to), colorOf(verdict), kLoop_px,
               kLoopOpacity);
}

void drawTrack(const MapTrack& track, const TopView& view, LinePen& pen) {
  if (track.poses.empty()) return;
  std::vector<Eigen::Vector2d> line;
  line.reserve(track.poses.size());
  for (const StampedPose& pose : track.poses) line.push_back(view.toPixel(pose.pose.translation()));
  // A white halo keeps the line apart from points of the same colour.
  pen.polyline(line, kWhite, kHalo_px);
  pen.polyline(line, robotColor(track.robot), kTrack_px);
  pen.ring(line.front(), kStartRadius_px, kWhite, kHalo_px);
  pen.ring(line.front(), kStartRadius_px, robotColor(track.robot), kTrack_px);
}

void drawFrame(const TopView& view, mrpt::img::CImage& image, int x0, int y0) {
  image.rectangle(x0 - 1, y0 - 1, x0 + view.width, y0 + view.height, {200, 200, 200});
}

mrpt::img::CImage render(const ComponentMap& map, const PictureOptions& options) {
  const TopView view = viewOf(map, options.size_px, options.finest_pixel_m);
  const int width = std::max(kLeastWidth_px, view.width + 2 * kMargin_px);
  const int x0 = (width - view.width) / 2, y0 = kMargin_px;
  const Legend legend(legendOf(map), view, width - 2 * kMargin_px);
  const int height = view.height + 3 * kMargin_px + legend.height();

  mrpt::img::CImage image(width, height, mrpt::img::CH_RGB);
  image.filledRectangle(0, 0, width, height, {255, 255, 255});
  drawPoints(map, view, options.tint, image, x0, y0);
  LinePen pen(image, x0, y0, view.width, view.height);
  if (options.rejected_loops) drawLoops(map, view, Verdict::kOutlier, pen);
  for (const MapTrack& track : map.tracks) drawTrack(track, view, pen);
  for (const Verdict verdict : {Verdict::kPending, Verdict::kInlier})
    drawLoops(map, view, verdict, pen);
  drawFrame(view, image, x0, y0);
  legend.draw(image, kMargin_px, view.height + 2 * kMargin_px);
  return image;
}

}  // namespace

std::vector<std::string> Picture::exportMap(const ComponentMap& map, const std::string& stem) {
  checkMap(map);
  const std::string path = stem + ".png";
  writePng(render(map, options_), path);
  return {path};
}

}  // namespace lamp
