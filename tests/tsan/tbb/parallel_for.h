// ThreadSanitizer does not see how TBB's library, which is built without it, orders what its threads
// do, and would take every loop for a race. With LAMP_SANITIZE=thread the folder of this file comes
// before TBB's: the same loops run on plain threads. What is checked is our code in the loops.
#pragma once

#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace tbb {

template <class Index, class Body>
void parallel_for(Index begin, Index end, const Body& body) {
  std::atomic<Index> next{begin};
  std::exception_ptr thrown;
  std::mutex mutex;
  const auto work = [&] {
    try {
      for (Index i; (i = next.fetch_add(1)) < end;) body(i);
    } catch (...) {
      const std::lock_guard<std::mutex> lock(mutex);
      thrown = std::current_exception();
    }
  };
  std::vector<std::thread> threads;
  for (int i = 0; i < 3; ++i) threads.emplace_back(work);
  work();
  for (std::thread& thread : threads) thread.join();
  if (thrown) std::rethrow_exception(thrown);
}

}  // namespace tbb
