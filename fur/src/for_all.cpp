#include "for_all.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace fur {

void ForAll(uint32_t count, uint32_t threads, const std::function<void(double)>& progress,
            const std::function<void(uint32_t)>& work) {
  if (threads == 0) threads = std::max(1u, std::thread::hardware_concurrency());
  std::atomic<uint32_t> next = 0;
  uint32_t done = 0;
  std::mutex mutex;
  std::exception_ptr failure;  // out of memory
  const auto run = [&] {
    try {
      for (uint32_t i = next++; i < count; i = next++) {
        work(i);
        const std::lock_guard lock(mutex);
        ++done;
        if (progress) progress(double(done) / count);
      }
    } catch (...) {
      const std::lock_guard lock(mutex);
      failure = std::current_exception();
      next = count;
    }
  };
  {
    std::vector<std::jthread> others;
    for (uint32_t i = 1; i < std::min(threads, count); ++i) others.emplace_back(run);
    run();
  }
  if (failure) std::rethrow_exception(failure);
}

}  // namespace fur
