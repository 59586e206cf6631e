#include "lamp/maps/RegistrationPicture.h"

#include <algorithm>
#include <cmath>

#include "Legend.h"
#include "LinePen.h"
#include "Png.h"
#include "TopView.h"

namespace lamp {

namespace {

constexpr int kPanel_px = 820;  ///< longer side
constexpr double kFinestPixel_m = 0.005;
constexpr int kMargin_px = 20, kTitle_px = 24;
constexpr double kDot_px = 3.0, kDotOpacity = 0.55;
constexpr double kSensor_px = 6.0, kSensorLine_px = 2.0;
constexpr Color kSourceColor{225, 95, 0}, kTargetColor{20, 95, 190};

using Points = std::vector<Eigen::Vector3f>;

/** From -y: what was up is then where +y is from above. */
Pose3 sideView() {
  Pose3 view_T_target = Pose3::Identity();
  view_T_target.linear() << 1, 0, 0, 0, 0, 1, 0, -1, 0;
  return view_T_target;
}

/** Both clouds seen from one side, with the source at one pose. */
struct Panel {
  Pose3 view_T_target, view_T_source;
  std::string title;
};

struct Row {
  std::vector<Panel> panels;
  TopView view;  ///< the same for all, so that the target is at the same place
};

std::vector<Panel> panelsOf(const RegistrationPicture& picture, const Pose3& view_T_target,
                            const std::string& from) {
  std::vector<Panel> panels{
      {view_T_target, view_T_target, "before, each in its own frame, " + from}};
  if (picture.target_T_source)
    panels.push_back({view_T_target, view_T_target * *picture.target_T_source, "after, " + from});
  return panels;
}

Eigen::AlignedBox2d boxOf(const RegistrationPicture& picture, const std::vector<Panel>& panels) {
  Eigen::AlignedBox2d box;
  const auto extend = [&](const Points& points, const Pose3& view_T_points) {
    for (const Eigen::Vector3f& p : points)
      box.extend((view_T_points * p.cast<double>()).head<2>().eval());
  };
  for (const Panel& panel : panels) {
    extend(picture.target.points, panel.view_T_target);
    extend(picture.source.points, panel.view_T_source);
  }
  return box;
}

/** Both rows at one scale. */
std::vector<Row> rowsOf(const RegistrationPicture& picture) {
  std::vector<Row> rows;
  std::vector<Eigen::AlignedBox2d> boxes;
  double pixel_m = kFinestPixel_m;
  for (const auto& [view_T_target, from] : {std::pair(Pose3(Pose3::Identity()), "from above"),
                                            std::pair(sideView(), "from the side")}) {
    rows.push_back({panelsOf(picture, view_T_target, from), {}});
    boxes.push_back(boxOf(picture, rows.back().panels));
    pixel_m = std::max(pixel_m, viewOf(boxes.back(), kPanel_px, kFinestPixel_m).pixel_m);
  }
  for (size_t i = 0; i < rows.size(); ++i) {
    TopView& view = rows[i].view = viewOf(boxes[i], kPanel_px, pixel_m);
    // Margins differ, but x must be the same from above and from the side.
    view.top_left.x() = rows.front().view.top_left.x();
    view.width = rows.front().view.width;
  }
  return rows;
}

/** Draws points of both clouds in turn, so that neither hides the other. */
void drawPoints(const RegistrationPicture& picture, const Panel& panel, const TopView& view,
                LinePen& pen) {
  const Points &source = picture.source.points, &target = picture.target.points;
  const auto dot = [&](const Points& points, size_t i, size_t of, const Pose3& view_T_points,
                       Color color) {
    for (size_t k = i * points.size() / of; k < (i + 1) * points.size() / of; ++k)
      pen.dot(view.toPixel(view_T_points * points[k].cast<double>()), color, kDot_px, kDotOpacity);
  };
  const size_t turns = std::max(source.size(), target.size());
  for (size_t i = 0; i < turns; ++i) {
    dot(target, i, turns, panel.view_T_target, kTargetColor);
    dot(source, i, turns, panel.view_T_source, kSourceColor);
  }
}

void drawPanel(const RegistrationPicture& picture, const Panel& panel, const TopView& view, int x0,
               int y0, mrpt::img::CImage& image) {
  image.selectTextFont("9x15");
  image.textOut(x0, y0, panel.title, {50, 50, 50});
  const int top = y0 + kTitle_px;
  LinePen pen(image, x0, top, view.width, view.height);
  drawPoints(picture, panel, view, pen);
  for (const auto& [pose, color] :
       {std::pair(panel.view_T_target, kTargetColor), std::pair(panel.view_T_source, kSourceColor)})
    pen.ring(view.toPixel(pose.translation()), kSensor_px, color, kSensorLine_px);
  image.rectangle(x0 - 1, top - 1, x0 + view.width, top + view.height, {200, 200, 200});
}

std::vector<LegendEntry> legendOf(const RegistrationPicture& picture) {
  const auto text = [](const char* role, const PicturedCloud& cloud) {
    return role + cloud.name + ", " + std::to_string(cloud.points.size()) + " points";
  };
  return {{kTargetColor, text("target ", picture.target)},
          {kSourceColor, text("source ", picture.source)},
          {picture.accepted ? kAcceptedColor : kRejectedColor, picture.verdict}};
}

}  // namespace

void writeRegistrationPicture(const std::string& path, const RegistrationPicture& picture) {
  const std::vector<Row> rows = rowsOf(picture);
  const TopView& view = rows.front().view;
  const int panel_width = view.width + kMargin_px;
  const auto columns = static_cast<int>(rows.front().panels.size());
  const int width = kMargin_px + std::max(kPanel_px, columns * panel_width);
  const Legend legend(legendOf(picture), view, width - 2 * kMargin_px);
  int height = 2 * kMargin_px + legend.height();
  for (const Row& row : rows) height += kTitle_px + row.view.height + kMargin_px;

  mrpt::img::CImage image(width, height, mrpt::img::CH_RGB);
  image.filledRectangle(0, 0, width, height, {255, 255, 255});
  int y = kMargin_px;
  for (const Row& row : rows) {
    int x = kMargin_px;
    for (const Panel& panel : row.panels) {
      drawPanel(picture, panel, row.view, x, y, image);
      x += panel_width;
    }
    y += kTitle_px + row.view.height + kMargin_px;
  }
  legend.draw(image, kMargin_px, y);
  writePng(image, path);
}

}  // namespace lamp
