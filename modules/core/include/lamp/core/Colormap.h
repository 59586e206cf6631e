#pragma once

#include <array>
#include <cstdint>

namespace lamp {

/** Viridis (van der Walt and Smith 2015; CC0), perceptually uniform, at equal steps. */
constexpr std::array<std::array<uint8_t, 3>, 9> kViridis = {{{68, 1, 84},
                                                             {72, 40, 120},
                                                             {62, 73, 137},
                                                             {49, 104, 142},
                                                             {38, 130, 142},
                                                             {31, 158, 137},
                                                             {53, 183, 121},
                                                             {110, 206, 88},
                                                             {253, 231, 37}}};

/** Colour of a value between 0 and 1; clamped. */
std::array<uint8_t, 3> viridis(double value);

}  // namespace lamp
