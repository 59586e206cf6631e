#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <sstream>
#include <string>

#include "lamp/core/Files.h"

namespace lamp::test {

/** A grid as ROS's map servers read it: the YAML's thresholds on the image's grey, from white to
 * black; the image's last row is the one at the origin. Values are those of an OccupancyGrid
 * message: 100 occupied, 0 free, -1 unknown. */
class MapServerGrid {
 public:
  explicit MapServerGrid(const std::string& yaml) : yaml_(readTextFile(yaml)) {
    resolution_ = number("resolution");
    std::istringstream origin(value("origin").substr(1));
    char comma;
    origin >> origin_x_ >> comma >> origin_y_;
    readImage(std::filesystem::path(yaml).replace_filename(value("image")));
  }

  double resolution() const { return resolution_; }
  int width() const { return width_; }
  int height() const { return height_; }
  double x(int column) const { return origin_x_ + (column + 0.5) * resolution_; }
  double y(int row) const { return origin_y_ + (row + 0.5) * resolution_; }

  /** \param row from the origin upwards. */
  int cell(int column, int row) const {
    const auto place = static_cast<size_t>((height_ - 1 - row) * width_ + column);
    const double gray = static_cast<uint8_t>(pixels_.at(place));
    const double occupied = number("negate") != 0 ? gray / 255 : (255 - gray) / 255;
    if (occupied > number("occupied_thresh")) return 100;
    return occupied < number("free_thresh") ? 0 : -1;
  }
  /** Of a point; -1 outside. */
  int at(double px, double py) const {
    const int column = static_cast<int>(std::floor((px - origin_x_) / resolution_)),
              row = static_cast<int>(std::floor((py - origin_y_) / resolution_));
    const bool inside = column >= 0 && column < width_ && row >= 0 && row < height_;
    return inside ? cell(column, row) : -1;
  }

 private:
  std::string value(const std::string& key) const {
    const size_t begin = yaml_.find("\n" + key + ": ");
    const size_t at = yaml_.rfind(key + ": ", 0) == 0 ? 0 : begin + 1;
    const size_t from = at + key.size() + 2;
    return yaml_.substr(from, yaml_.find('\n', from) - from);
  }
  double number(const std::string& key) const { return std::stod(value(key)); }

  void readImage(const std::string& path) {
    std::istringstream file(readTextFile(path));
    const auto next = [&] {
      std::string word;
      while (file >> word && word[0] == '#') std::getline(file, word);
      return word;
    };
    EXPECT_EQ(next(), "P5");
    width_ = std::stoi(next());
    height_ = std::stoi(next());
    EXPECT_EQ(next(), "255");
    file.get();
    pixels_.resize(static_cast<size_t>(width_ * height_));
    file.read(pixels_.data(), static_cast<std::streamsize>(pixels_.size()));
    EXPECT_EQ(file.gcount(), static_cast<std::streamsize>(pixels_.size()));
    EXPECT_EQ(file.peek(), EOF);
  }

  std::string yaml_, pixels_;
  double resolution_ = 0, origin_x_ = 0, origin_y_ = 0;
  int width_ = 0, height_ = 0;
};

}  // namespace lamp::test
