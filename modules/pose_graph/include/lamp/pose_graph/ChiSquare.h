#pragma once

namespace lamp {

/** Probability that a chi-square variable exceeds x >= 0. */
double chiSquareSurvival(double x, int degrees_of_freedom);

/** The x that a chi-square variable stays below with the given probability, to full precision.
 * \throws std::invalid_argument unless 0 <= probability < 1 and degrees_of_freedom >= 1. */
double chiSquareQuantile(double probability, int degrees_of_freedom);

}  // namespace lamp
