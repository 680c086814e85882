// One workload, four ways: by hand on Vulkan and on OpenGL, and through the RHI on both. Every way records the same
// draws with the same constants and switches, and gives the same picture, so that what differs is the cost of the RHI.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace rhi_overhead {

inline constexpr uint32_t kDraws = 10000;  // of one frame
inline constexpr uint32_t kSize = 128;     // of the target, in pixels; RGBA8
inline constexpr uint32_t kConstantSlot = 3;

struct DrawConstants {
  std::array<float, 4> place;  // clip space: left, top, width, height (negative) of the pixel
  std::array<float, 4> color;
};
static_assert(sizeof(DrawConstants) == 32);

// The constants of every draw, made beforehand: what it costs to think them up is not measured.
const std::vector<DrawConstants>& Constants();

class Loop {
 public:
  virtual ~Loop() = default;
  // Clears, draws kDraws pixels, switches between two programs and two blend states before every draw whose number is a
  // multiple of `switchEvery`, submits, and waits.
  virtual void Frame(uint32_t switchEvery) = 0;
  virtual std::vector<uint8_t> Picture() = 0;  // of the last frame, row 0 on top
};

// They throw std::runtime_error where something is missing.
std::unique_ptr<Loop> MakeRawVulkan();
std::unique_ptr<Loop> MakeRawGl();
std::unique_ptr<Loop> MakeRhiVulkan();
std::unique_ptr<Loop> MakeRhiGl();

}  // namespace rhi_overhead
