#include "VectorKernels.h"

#include <algorithm>
#include <cmath>

namespace lamp {

LAMP_FOR_SEVERAL_INSTRUCTION_SETS
void weightedRowSum(const float* rows, size_t columns, const float* weights, size_t count,
                    float* __restrict result) {
  constexpr size_t kBlock = 64;  // as many sums as stay in registers
  for (size_t first = 0; first < columns; first += kBlock) {
    const size_t width = std::min(kBlock, columns - first);
    float sums[kBlock] = {};
    if (width == kBlock) {
      for (size_t k = 0; k < count; ++k)
        for (size_t j = 0; j < kBlock; ++j) sums[j] += weights[k] * rows[k * columns + first + j];
    } else {
      for (size_t k = 0; k < count; ++k)
        for (size_t j = 0; j < width; ++j) sums[j] += weights[k] * rows[k * columns + first + j];
    }
    std::copy(sums, sums + width, result + first);
  }
}

LAMP_FOR_SEVERAL_INSTRUCTION_SETS
void consistentWith(const float* columns, size_t count, size_t i, float distance, float angle,
                    int32_t* __restrict consistent) {
  const float *px = columns, *py = px + count, *pz = py + count;
  const float *qx = pz + count, *qy = qx + count, *qz = qy + count;
  const float *mx = qz + count, *my = mx + count, *mz = my + count;
  const float *nx = mz + count, *ny = nx + count, *nz = ny + count;
  for (size_t j = i + 1; j < count; ++j) {
    const float ax = px[j] - px[i], ay = py[j] - py[i], az = pz[j] - pz[i];
    const float bx = qx[j] - qx[i], by = qy[j] - qy[i], bz = qz[j] - qz[i];
    const float length = std::sqrt(ax * ax + ay * ay + az * az);
    const float difference = std::abs(length - std::sqrt(bx * bx + by * by + bz * bz));
    // Cosines, and heights over length, change at most by the angle.
    const float cosines = std::abs(mx[i] * mx[j] + my[i] * my[j] + mz[i] * mz[j] -
                                   (nx[i] * nx[j] + ny[i] * ny[j] + nz[i] * nz[j]));
    const float height_i =
        std::abs(mx[i] * ax + my[i] * ay + mz[i] * az - (nx[i] * bx + ny[i] * by + nz[i] * bz));
    const float height_j =
        std::abs(mx[j] * ax + my[j] * ay + mz[j] * az - (nx[j] * bx + ny[j] * by + nz[j] * bz));
    const float max_height = distance + angle * length;
    consistent[j] = static_cast<int32_t>((difference <= distance) & (cosines <= angle) &
                                         (height_i <= max_height) & (height_j <= max_height));
  }
}

LAMP_FOR_SEVERAL_INSTRUCTION_SETS
size_t countCommon(const uint64_t* a, const uint64_t* b, size_t words) {
  size_t sum = 0;
  for (size_t w = 0; w < words; ++w) sum += static_cast<size_t>(__builtin_popcountll(a[w] & b[w]));
  return sum;
}

LAMP_FOR_SEVERAL_INSTRUCTION_SETS
Connections mostConnected(const uint64_t* rows, size_t words, const uint64_t* set) {
  Connections most;
  bool found = false;
  for (size_t w = 0; w < words; ++w)
    for (uint64_t rest = set[w]; rest != 0; rest &= rest - 1) {
      const size_t vertex = 64 * w + static_cast<size_t>(__builtin_ctzll(rest));
      const uint64_t* row = rows + vertex * words;
      size_t count = 0;
      for (size_t k = 0; k < words; ++k)
        count += static_cast<size_t>(__builtin_popcountll(row[k] & set[k]));
      if (found && count <= most.count) continue;
      most = {static_cast<uint32_t>(vertex), count};
      found = true;
    }
  return most;
}

}  // namespace lamp
