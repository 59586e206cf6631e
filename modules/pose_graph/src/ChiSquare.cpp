#include "lamp/pose_graph/ChiSquare.h"

#include <cmath>
#include <stdexcept>
#include <string>

namespace lamp {

double chiSquareSurvival(double x, int degrees_of_freedom) {
  // Q(a + 1, h) = Q(a, h) + h^a e^-h / Γ(a + 1), from the closed forms for one and two degrees.
  const double h = 0.5 * x;
  const bool odd = degrees_of_freedom % 2 != 0;
  double a = odd ? 0.5 : 1.0;
  double survival = odd ? std::erfc(std::sqrt(h)) : std::exp(-h);
  double term = odd ? std::sqrt(h / M_PI) * 2.0 * std::exp(-h) : h * std::exp(-h);
  for (; a < 0.5 * degrees_of_freedom - 0.25; a += 1.0) {
    survival += term;
    term *= h / (a + 1.0);
  }
  return survival;
}

double chiSquareQuantile(double probability, int degrees_of_freedom) {
  if (!(probability >= 0.0 && probability < 1.0) || degrees_of_freedom < 1)
    throw std::invalid_argument("chi-square quantile of probability " +
                                std::to_string(probability) + " with " +
                                std::to_string(degrees_of_freedom) +
                                " degrees of freedom: need 0 <= probability < 1 and a degree");
  const double target = 1.0 - probability;
  double low = 0.0, high = 1.0;
  while (chiSquareSurvival(high, degrees_of_freedom) > target) high *= 2.0;
  for (;;) {
    const double middle = 0.5 * (low + high);
    if (middle <= low || middle >= high) return middle;
    (chiSquareSurvival(middle, degrees_of_freedom) > target ? low : high) = middle;
  }
}

}  // namespace lamp
