#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <string>

#include "lamp/core/Stage.h"

namespace lamp::test {

/** The stage with its default options, as the ini makes it. */
template <class Base>
std::shared_ptr<Base> makeDefault(const std::string& name) {
  Faults faults;
  auto stage = makeStage<Base>(StageName::parse(name), "stage", "", Ini{}, faults);
  faults.throwIfAny();
  return stage;
}

/** The name of a test of one stage. */
inline std::string testName(const testing::TestParamInfo<std::string>& info) {
  return info.param;
}

}  // namespace lamp::test
