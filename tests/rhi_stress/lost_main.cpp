// Puts the layer of lost_layer.cpp between this program and the driver, before there is a Vulkan instance.
#include <dlfcn.h>
#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>

#include "lost_layer.h"

namespace rhi_stress {

const LostLayer& TheLostLayer() {
  static const LostLayer* layer = [] {
    void* module = dlopen(LOST_LAYER_FILE, RTLD_NOW);
    const auto entry = module ? reinterpret_cast<LostLayerEntry>(dlsym(module, kLostLayerEntry)) : nullptr;
    if (!entry) std::fprintf(stderr, "%s\n", dlerror());
    if (!entry) std::abort();
    return entry();
  }();
  return *layer;
}

}  // namespace rhi_stress

int main(int argc, char** argv) {
  setenv("VK_ADD_LAYER_PATH", LOST_LAYER_DIR, 1);  // beside the usual folders, where the validation layer is
  setenv("VK_INSTANCE_LAYERS", rhi_stress::kLostLayerName, 1);
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
