// Work over several threads.
#pragma once

#include <cstdint>
#include <functional>

namespace fur {

// Runs work(0) .. work(count - 1), each once; threads 0: one for each core. `progress`, if any, is called with 0..1,
// never less than before, one call at a time. An exception of the work's is thrown on, after all threads have ended.
void ForAll(uint32_t count, uint32_t threads, const std::function<void(double)>& progress,
            const std::function<void(uint32_t)>& work);

}  // namespace fur
