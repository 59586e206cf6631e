#pragma once

#include "lamp/upper/Upper.h"

namespace lamp {

enum class Sent {
  kNo,
};

}  // namespace lamp
