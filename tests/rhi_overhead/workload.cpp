#include "workload.h"

namespace rhi_overhead {
namespace {

std::vector<DrawConstants> MakeConstants() {
  constexpr float kStep = 2.0f / float(kSize);
  std::vector<DrawConstants> list(kDraws);
  for (uint32_t i = 0; i < kDraws; ++i) {
    const uint32_t x = i % kSize, y = i / kSize % kSize;
    list[i].place = {float(x) * kStep - 1, 1 - float(y) * kStep, kStep, -kStep};
    list[i].color = {float(x) / kSize, float(y) / kSize, float(i % 7) / 7, 0.5f};
  }
  return list;
}

}  // namespace

const std::vector<DrawConstants>& Constants() {
  static const std::vector<DrawConstants> constants = MakeConstants();
  return constants;
}

}  // namespace rhi_overhead
