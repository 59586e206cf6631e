#include "solver/BlockKernels.h"

#include <vector>

namespace lamp {

extern const BlockKernels kPortableKernels, kAvx2Kernels, kAvx512Kernels;

std::vector<const BlockKernels*> availableBlockKernels() {
  std::vector<const BlockKernels*> kernels;
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx512f")) kernels.push_back(&kAvx512Kernels);
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"))
    kernels.push_back(&kAvx2Kernels);
#endif
  kernels.push_back(&kPortableKernels);
  return kernels;
}

const BlockKernels& bestBlockKernels() {
  static const BlockKernels& kBest = *availableBlockKernels().front();
  return kBest;
}

}  // namespace lamp
