#include "Legend.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "MapPoints.h"
#include "lamp/core/Csv.h"

namespace lamp {

namespace {

constexpr const char* kFont = "9x15";
constexpr int kCharacter_px = 9;
constexpr int kRow_px = 22;
constexpr int kSwatch_px = 12;
constexpr int kGap_px = 8;
constexpr int kColumnGap_px = 28;
constexpr double kBarShare = 0.15;
constexpr double kLeastBar_px = 40, kMaxBar_px = 250;
const mrpt::img::TColor kTextColor(50, 50, 50);

int widthOf(const std::string& text) {
  return kCharacter_px * static_cast<int>(text.size());
}

std::string counted(size_t n, const std::string& thing) {
  return std::to_string(n) + " " + thing + (n == 1 ? "" : "s");
}

std::string barLabel(double length_m) {
  if (length_m >= 1000) return formatDouble(length_m / 1000) + " km";
  if (length_m < 1) return formatDouble(length_m * 100) + " cm";
  return formatDouble(length_m) + " m";
}

}  // namespace

double roundLength(double length) {
  const double power = std::pow(10.0, std::floor(std::log10(length)));
  for (const double factor : {5.0, 2.0})
    if (factor * power <= length) return factor * power;
  return power;
}

Legend::Legend(std::vector<LegendEntry> entries, const TopView& view, int width_px)
    : entries_(std::move(entries)), width_px_(width_px), pixel_m_(view.pixel_m) {
  const double bar_px = std::clamp(kBarShare * view.width, kLeastBar_px, kMaxBar_px);
  bar_m_ = roundLength(bar_px * pixel_m_);
  const int room = width_px_ - static_cast<int>(kMaxBar_px) - kColumnGap_px;
  int column = 0;
  for (const LegendEntry& entry : entries_) {
    const int width = kSwatch_px + kGap_px + widthOf(entry.text);
    if (column > 0 && column + width > room) {
      column = 0;
      ++rows_;
    }
    places_.push_back({column, rows_ - 1});
    column += width + kColumnGap_px;
  }
}

int Legend::height() const {
  return std::max(2, rows_) * kRow_px;
}

void Legend::draw(mrpt::img::CImage& image, int x0, int y0) const {
  image.selectTextFont(kFont);
  for (size_t i = 0; i < entries_.size(); ++i) {
    const int x = x0 + places_[i].column_px, y = y0 + places_[i].row * kRow_px;
    const Color& color = entries_[i].color;
    image.filledRectangle(x, y + 2, x + kSwatch_px, y + 2 + kSwatch_px,
                          {color.r, color.g, color.b});
    image.textOut(x + kSwatch_px + kGap_px, y, entries_[i].text, kTextColor);
  }
  drawScaleBar(image, x0 + width_px_, y0);
}

void Legend::drawScaleBar(mrpt::img::CImage& image, int right, int y0) const {
  constexpr int kTick_px = 4, kBelowText_px = 24;
  const int length = static_cast<int>(std::lround(bar_m_ / pixel_m_)), left = right - length;
  const int y = y0 + kBelowText_px;
  image.filledRectangle(left, y - 1, right, y + 1, kTextColor);
  for (const int end : {left, right})
    image.filledRectangle(end - 1, y - kTick_px, end, y + kTick_px, kTextColor);
  const std::string label = barLabel(bar_m_);
  image.textOut((left + right - widthOf(label)) / 2, y0, label, kTextColor);
}

std::vector<LegendEntry> legendOf(const ComponentMap& map) {
  std::map<RobotId, size_t> key_nodes;
  for (const MapTrack& track : map.tracks) key_nodes[track.robot];
  for (const MapKeyNode& key_node : map.key_nodes) ++key_nodes[key_node.id.robot];
  std::vector<LegendEntry> entries;
  for (const auto& [robot, count] : key_nodes)
    entries.push_back(
        {robotColor(robot), robotName(map, robot) + ": " + counted(count, "key node")});

  const auto loops = [&](Verdict verdict) {
    return std::count_if(map.loops.begin(), map.loops.end(),
                         [verdict](const MapLoop& loop) { return loop.verdict == verdict; });
  };
  entries.push_back({kAcceptedColor, counted(loops(Verdict::kInlier), "loop") + " accepted"});
  entries.push_back({kRejectedColor, std::to_string(loops(Verdict::kOutlier)) + " rejected"});
  if (const auto pending = loops(Verdict::kPending); pending > 0)
    entries.push_back({kPendingColor, std::to_string(pending) + " undecided"});
  return entries;
}

}  // namespace lamp
