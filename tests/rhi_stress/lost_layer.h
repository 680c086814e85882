// What a test can tell the layer of lost_layer.cpp: which calls of the Vulkan driver shall fail. The layer is a module
// of its own, which the loader opens; the test opens the same file and asks it for kLostLayerEntry.
#pragma once

#include <cstdint>

namespace rhi_stress {

inline constexpr const char* kLostLayerName = "VK_LAYER_FUR_lost";
inline constexpr const char* kLostLayerEntry = "FurLostLayer";

inline constexpr int32_t kOutOfHostMemory = -1, kOutOfDeviceMemory = -2, kDeviceLost = -4;  // VkResult's numbers
inline constexpr uint32_t kForever = ~0u;

struct LostLayer {
  // Let `skip` calls of `function` pass, then give `result` (a VkResult) `times` times. Replaces what was told before.
  // A device that has given VK_ERROR_DEVICE_LOST gives it to all that can, from then on.
  void (*fail)(const char* function, int32_t result, uint32_t skip, uint32_t times);
  void (*pass)();                    // nothing fails any more; lost devices stay lost
  uint32_t (*failures)();            // how many calls have failed since `fail`
  void (*hideDrawParameters)(bool);  // of devices made from now on
  // Pretends to be a driver with a pipeline cache that can be saved, for devices made from now on.
  void (*saveCaches)(bool);
  uint32_t (*warmCaches)();           // how many caches were made of intact data since then
  const char* const* (*functions)();  // those that can fail; ends with null
};
using LostLayerEntry = const LostLayer* (*)();
const LostLayer& TheLostLayer();  // lost_main.cpp

}  // namespace rhi_stress
