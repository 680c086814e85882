// rhi_overhead MODE [FRAMES [every-100]]: draws frames of the workload and prints how long they took, with a switch
// every 100 draws and then with one for every draw. tools/measure_overhead.sh runs it under callgrind, which counts
// what is done in the two functions below.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>

#include "workload.h"

namespace {

using rhi_overhead::Loop;
using FrameFunction = void (*)(Loop&);

constexpr int kWarmUpFrames = 2;  // pages of rings and command buffers come round, caches fill

struct Mode {
  const char* name;
  std::unique_ptr<Loop> (*make)();
};
constexpr Mode kModes[] = {{"raw-vulkan", rhi_overhead::MakeRawVulkan},
                           {"rhi-vulkan", rhi_overhead::MakeRhiVulkan},
                           {"raw-gl", rhi_overhead::MakeRawGl},
                           {"rhi-gl", rhi_overhead::MakeRhiGl}};

double MillisecondsOf(FrameFunction frame, Loop& loop) {
  const auto start = std::chrono::steady_clock::now();
  frame(loop);
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

// "every-100 8.123": the median of the frames, in milliseconds.
void Measure(const char* what, FrameFunction frame, Loop& loop, int frames) {
  std::vector<double> times;
  for (int i = 0; i < frames; ++i) times.push_back(MillisecondsOf(frame, loop));
  std::sort(times.begin(), times.end());
  std::printf("%s %.3f\n", what, times[times.size() / 2]);
}

uint64_t Hash(const std::vector<uint8_t>& bytes) {
  uint64_t h = 0xcbf29ce484222325ull;
  for (const uint8_t b : bytes) h = (h ^ b) * 0x100000001b3ull;
  return h;
}

}  // namespace

// Named without C++'s ornaments, never inlined, and with something after the call (which is therefore no jump), so that
// callgrind sees them begin and end.
extern "C" {
[[gnu::noinline]] void rhi_overhead_every_100(Loop& loop) {
  loop.Frame(100);
  asm volatile("" ::: "memory");
}
[[gnu::noinline]] void rhi_overhead_every_draw(Loop& loop) {
  loop.Frame(1);
  asm volatile("" ::: "memory");
}
}

namespace {

int Run(const Mode& mode, int frames, bool onlyEvery100) {
  const std::unique_ptr<Loop> loop = mode.make();
  for (int i = 0; i < kWarmUpFrames; ++i) loop->Frame(100);
  Measure("every-100", rhi_overhead_every_100, *loop, frames);
  std::printf("picture %016llx\n", static_cast<unsigned long long>(Hash(loop->Picture())));
  if (onlyEvery100) return 0;
  loop->Frame(1);
  Measure("every-draw", rhi_overhead_every_draw, *loop, frames);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  const int frames = argc > 2 ? std::atoi(argv[2]) : 5;
  for (const Mode& mode : kModes) {
    if (argc < 2 || frames < 1 || std::strcmp(argv[1], mode.name) != 0) continue;
    try {
      return Run(mode, frames, argc > 3);
    } catch (const std::exception& error) {
      std::fprintf(stderr, "rhi_overhead %s: %s\n", mode.name, error.what());
      return 1;
    }
  }
  std::fprintf(stderr, "usage: rhi_overhead raw-vulkan|rhi-vulkan|raw-gl|rhi-gl [FRAMES [every-100]]\n");
  return 2;
}
