#pragma once

#include <sys/resource.h>

#include <cstddef>
#include <optional>

namespace lamp {

/** While it lives, the program can allocate only so much more: beyond, `new` throws.
 *
 * MRPT sizes strings and vectors by what it reads, before it knows whether as many data follow; one
 * flipped bit would otherwise fill the memory until the kernel kills the run. See announcedSize()
 * for those that do not throw. The limit holds for all
 * threads (nothing finer exists), so it must be generous and short-lived. Without effect where
 * /proc is missing or the system's own limit is lower. */
class AllocationLimit {
 public:
  explicit AllocationLimit(size_t more_bytes);
  ~AllocationLimit();
  AllocationLimit(const AllocationLimit&) = delete;
  AllocationLimit& operator=(const AllocationLimit&) = delete;

 private:
  std::optional<rlimit> previous_;
};

}  // namespace lamp
