#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "PairRegistration.h"

namespace lamp {

/** For the screen: what each stage made of the pair. */
std::string registerReport(const PairRegistration& pair);

/** The cloud's offset in words. */
std::string offsetText(const RegisteredCloud& cloud);

/** The same for programs (docs/registration.md). */
nlohmann::ordered_json registerJson(const PairRegistration& pair);

}  // namespace lamp
