#pragma once

#include <mrpt/img/CImage.h>

#include <vector>

#include "TopView.h"

namespace lamp {

/** Counts points by pixel and robot colour, and draws the counts as ink on white. */
class DensityImage {
 public:
  explicit DensityImage(const TopView& view);

  /** Points outside of the view are passed over. */
  void add(const Eigen::Vector3d& world, Color color);
  /** \param x0,y0 where the view's top left pixel goes. \param tint in the robots' colours, else
   * grey. */
  void draw(mrpt::img::CImage& image, int x0, int y0, bool tint) const;

 private:
  struct Pixel {
    float count = 0;
    float r = 0, g = 0, b = 0;  ///< sums
  };
  /** The count that is drawn in full ink. */
  float fullCount() const;

  TopView view_;
  std::vector<Pixel> pixels_;
};

}  // namespace lamp
