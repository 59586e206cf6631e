// See parallel_for.h.
#pragma once

#include <tbb/blocked_range.h>

#include <vector>

#include "parallel_for.h"

namespace tbb {

template <class Value, class Result, class Body, class Join>
Result parallel_reduce(const blocked_range<Value>& range, const Result& identity, const Body& body,
                       const Join& join) {
  constexpr Value kParts = 8;
  const Value size = range.end() - range.begin();
  std::vector<Result> parts(kParts, identity);
  parallel_for(Value{0}, kParts, [&](Value i) {
    parts[i] = body({range.begin() + size * i / kParts, range.begin() + size * (i + 1) / kParts},
                    identity);
  });
  Result all = identity;
  for (const Result& part : parts) all = join(all, part);
  return all;
}

}  // namespace tbb
