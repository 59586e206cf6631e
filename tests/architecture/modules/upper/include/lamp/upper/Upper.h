#pragma once

namespace lamp {

enum class Sent {
  kYes,
};

}  // namespace lamp
