// A back buffer of our own, an ordinary texture, and the images of a window that Present brings it to. So an off-screen
// picture and the window's are the same bits, the back buffer is valid at all times, and what the window does to its
// images (new size, none free) never shows outside of Present.
#pragma once

#include "resources.h"
#include "surface.h"

namespace rhi_vulkan {

// Not a VkObject: it must be gone before its window is, so its last Release waits for the GPU and destroys at once.
class SwapChain final : public backend::Object<ISwapChain> {
 public:
  SwapChain(std::shared_ptr<Core> core, const SwapChainDesc& desc) : core_(std::move(core)), desc_(desc) {}
  ~SwapChain() override;
  Status Create();

  ITexture* BackBuffer() override { return backBuffer_.get(); }
  Status Present() override;
  Status Resize(uint32_t width, uint32_t height) override;

 private:
  // Does the chain suit the window? Unsure: only if the window's size is still the same. Broken: never again.
  enum class Fit : uint8_t { Good, Unsure, Broken };
  struct Image {
    VkImage handle = VK_NULL_HANDLE;
    VkSemaphore written = VK_NULL_HANDLE;  // from our copy to the presentation; free when the image is acquired again
  };
  struct Slot {
    VkSemaphore acquired = VK_NULL_HANDLE;
    uint64_t serial = 0;  // of the submission that waits for it
  };

  Status CreateBackBuffer();
  Status FitChain();
  Status CreateChain(const VkSurfaceCapabilitiesKHR&, VkExtent2D);
  Status CreateImages();
  Status CreateSemaphore(VkSemaphore*);
  void DestroyChain();
  Status Acquire(uint32_t* image);
  Status Queue(uint32_t image);
  Status Check(VkResult, const char* what);

  std::shared_ptr<Core> core_;
  SwapChainDesc desc_;
  Ref<Texture> backBuffer_;
  Surface surface_;
  VkSwapchainKHR chain_ = VK_NULL_HANDLE;
  VkExtent2D extent_{};
  Fit fit_ = Fit::Broken;
  std::vector<Image> images_;
  std::vector<Slot> slots_;
  size_t nextSlot_ = 0;
  bool minimised_ = false, lost_ = false;
};

}  // namespace rhi_vulkan
