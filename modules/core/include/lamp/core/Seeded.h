#pragma once

#include <cstdint>

namespace lamp {

/** What a stage that draws random numbers is as well: it takes its seed from the run, so that one
 * key of the ini, `[run] seed`, changes everything random. */
class Seeded {
 public:
  virtual ~Seeded() = default;
  /** Called before the stage is used. */
  virtual void setSeed(uint32_t seed) = 0;
};

}  // namespace lamp
