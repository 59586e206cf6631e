#include "AllocationLimit.h"

#include <unistd.h>

#include <fstream>

namespace lamp {
namespace {

/** Address space in use, bytes; 0 if unknown. */
rlim_t addressSpace() {
  rlim_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  return pages * static_cast<rlim_t>(sysconf(_SC_PAGESIZE));
}

}  // namespace

AllocationLimit::AllocationLimit(size_t more_bytes) {
  const rlim_t used = addressSpace();
  rlimit limit{};
  if (used == 0 || getrlimit(RLIMIT_AS, &limit) != 0) return;
  const rlim_t wanted = used + more_bytes;
  if (limit.rlim_cur != RLIM_INFINITY && limit.rlim_cur <= wanted) return;
  const rlimit lowered{wanted, limit.rlim_max};
  if (setrlimit(RLIMIT_AS, &lowered) == 0) previous_ = limit;
}

AllocationLimit::~AllocationLimit() {
  if (previous_) setrlimit(RLIMIT_AS, &*previous_);
}

}  // namespace lamp
