#include "swap_chain.h"

#include "context.h"

namespace rhi_vulkan {
namespace {

// A hidden window may never give an image; the program must not hang for it.
constexpr uint64_t kAcquireTimeoutNs = 1'000'000'000;
constexpr uint32_t kAnyExtent = ~0u;

// The window's size, or where the window takes any size, the back buffer's.
VkExtent2D ExtentOf(const VkSurfaceCapabilitiesKHR& caps, const SwapChainDesc& desc) {
  if (caps.currentExtent.width != kAnyExtent) return caps.currentExtent;
  return {std::clamp(desc.width, caps.minImageExtent.width, caps.maxImageExtent.width),
          std::clamp(desc.height, caps.minImageExtent.height, caps.maxImageExtent.height)};
}

VkCompositeAlphaFlagBitsKHR AlphaOf(const VkSurfaceCapabilitiesKHR& caps) {
  if (caps.supportedCompositeAlpha & VK_COMPOSITE_ALPHA_OPAQUE_BIT_KHR) return VK_COMPOSITE_ALPHA_OPAQUE_BIT_KHR;
  return VK_COMPOSITE_ALPHA_INHERIT_BIT_KHR;
}

}  // namespace

SwapChain::~SwapChain() {
  DestroyChain();
  surface_.Close(*core_);
}

Status SwapChain::Create() {
  if (Status s = surface_.Open(*core_, desc_); s != Status::Ok) return s;
  if (Status s = CreateBackBuffer(); s != Status::Ok) return s;
  return FitChain();
}

Status SwapChain::CreateBackBuffer() {
  TextureDesc desc = backend::BackBufferDesc(desc_.width, desc_.height, desc_.format);
  if (Status s = backend::CheckTextureDesc(&desc, nullptr, core_->adapter.caps, core_->log); s != Status::Ok) return s;
  auto texture = Ref<Texture>::Adopt(new Texture(core_, desc));
  const Status s = texture->Create();
  if (s == Status::Ok) backBuffer_ = texture;
  return s;
}

Status SwapChain::Resize(uint32_t width, uint32_t height) {
  if (core_->lost || !core_->context) return Status::DeviceLost;
  minimised_ = width == 0 || height == 0;
  if (minimised_) return Status::Ok;
  const SwapChainDesc before = desc_;
  desc_.width = width;
  desc_.height = height;
  const Status s = CreateBackBuffer();
  if (s != Status::Ok) desc_ = before;
  if (fit_ == Fit::Good) fit_ = Fit::Unsure;
  return s;
}

Status SwapChain::Present() {
  Context* context = core_->context;
  if (core_->lost || !context) return Status::DeviceLost;
  if (lost_) return Status::SurfaceLost;
  if (minimised_) return Status::Ok;
  uint32_t image = 0;
  const Status acquired = Acquire(&image);
  if (acquired == Status::StillDrawing) return context->SubmitAll();  // the window takes no picture now
  if (acquired != Status::Ok) return acquired;
  Slot& slot = slots_[nextSlot_];
  slot.serial = core_->recording;
  nextSlot_ = (nextSlot_ + 1) % slots_.size();
  const Status written = context->WriteWindowImage(
      *backBuffer_, {images_[image].handle, surface_.format.format, extent_}, {slot.acquired, images_[image].written});
  return written == Status::Ok ? Queue(image) : written;
}

// Ok with an image; StillDrawing: there is none to be had.
Status SwapChain::Acquire(uint32_t* image) {
  constexpr int kAttempts = 3;  // a window may change its size between any two calls
  for (int attempt = 0; attempt < kAttempts; ++attempt) {
    if (Status s = FitChain(); s != Status::Ok) return s;
    if (!chain_) return Status::StillDrawing;  // a window without area
    const Slot& slot = slots_[nextSlot_];
    if (Status s = core_->Wait(slot.serial); s != Status::Ok) return s;
    const VkResult result =
        core_->vk.vkAcquireNextImageKHR(core_->device, chain_, kAcquireTimeoutNs, slot.acquired, VK_NULL_HANDLE, image);
    if (result == VK_TIMEOUT || result == VK_NOT_READY) return Status::StillDrawing;
    if (result == VK_SUBOPTIMAL_KHR) fit_ = Fit::Unsure;  // an image all the same; the next Present looks
    if (result == VK_SUBOPTIMAL_KHR) return Status::Ok;
    if (result != VK_ERROR_OUT_OF_DATE_KHR) return Check(result, "vkAcquireNextImageKHR");
    fit_ = Fit::Broken;
  }
  return Status::StillDrawing;
}

Status SwapChain::Queue(uint32_t image) {
  VkPresentInfoKHR info{VK_STRUCTURE_TYPE_PRESENT_INFO_KHR};
  info.waitSemaphoreCount = 1;
  info.pWaitSemaphores = &images_[image].written;
  info.swapchainCount = 1;
  info.pSwapchains = &chain_;
  info.pImageIndices = &image;
  const VkResult result = core_->vk.vkQueuePresentKHR(core_->queue, &info);
  if (result == VK_SUBOPTIMAL_KHR) fit_ = Fit::Unsure;
  if (result == VK_ERROR_OUT_OF_DATE_KHR) fit_ = Fit::Broken;
  if (result == VK_SUBOPTIMAL_KHR || result == VK_ERROR_OUT_OF_DATE_KHR) return Status::Ok;
  return Check(result, "vkQueuePresentKHR");
}

Status SwapChain::Check(VkResult result, const char* what) {
  if (result == VK_ERROR_SURFACE_LOST_KHR) {
    lost_ = true;
    core_->log.Report(Severity::Error, MsgCode::SurfaceLost, "",
                      "%s: the window is gone; release the swap chain before its window is destroyed", what);
    return Status::SurfaceLost;
  }
  return core_->Check(result, "", what);
}

// Makes the images anew where they no longer suit the window.
Status SwapChain::FitChain() {
  if (fit_ == Fit::Good) return Status::Ok;
  VkSurfaceCapabilitiesKHR caps{};
  if (Status s = Check(surface_.Query(*core_, &caps), "looking at the window of a swap chain"); s != Status::Ok)
    return s;
  const VkExtent2D now = ExtentOf(caps, desc_);
  const bool same = now.width == extent_.width && now.height == extent_.height;
  if (chain_ && same && fit_ == Fit::Unsure) {
    fit_ = Fit::Good;
    return Status::Ok;
  }
  if (now.width == 0 || now.height == 0) {
    DestroyChain();
    return Status::Ok;
  }
  return CreateChain(caps, now);
}

Status SwapChain::CreateChain(const VkSurfaceCapabilitiesKHR& caps, VkExtent2D extent) {
  DestroyChain();  // an old chain could help the driver along, but its pictures still being shown would have to be kept
  VkSwapchainCreateInfoKHR info{VK_STRUCTURE_TYPE_SWAPCHAIN_CREATE_INFO_KHR};
  info.surface = surface_.handle;
  info.minImageCount = std::max(desc_.bufferCount, caps.minImageCount);
  if (caps.maxImageCount != 0) info.minImageCount = std::min(info.minImageCount, caps.maxImageCount);
  info.imageFormat = surface_.format.format;
  info.imageColorSpace = surface_.format.colorSpace;
  info.imageExtent = extent;
  info.imageArrayLayers = 1;
  info.imageUsage = VK_IMAGE_USAGE_TRANSFER_DST_BIT;
  info.imageSharingMode = VK_SHARING_MODE_EXCLUSIVE;
  info.preTransform = caps.currentTransform;
  info.compositeAlpha = AlphaOf(caps);
  info.presentMode = surface_.mode;
  info.clipped = VK_TRUE;
  const VkResult result = core_->vk.vkCreateSwapchainKHR(core_->device, &info, nullptr, &chain_);
  if (Status s = Check(result, "vkCreateSwapchainKHR"); s != Status::Ok) return s;
  extent_ = extent;
  const Status s = CreateImages();
  if (s == Status::Ok) fit_ = Fit::Good;
  return s;
}

Status SwapChain::CreateImages() {
  uint32_t count = 0;
  core_->vk.vkGetSwapchainImagesKHR(core_->device, chain_, &count, nullptr);
  std::vector<VkImage> handles(count);
  const VkResult result = core_->vk.vkGetSwapchainImagesKHR(core_->device, chain_, &count, handles.data());
  if (Status s = core_->Check(result, "", "vkGetSwapchainImagesKHR"); s != Status::Ok) return s;
  images_.resize(count);
  slots_.resize(count + 1);
  nextSlot_ = 0;
  for (uint32_t i = 0; i < count; ++i) {
    images_[i].handle = handles[i];
    core_->SetName(VK_OBJECT_TYPE_IMAGE, uint64_t(handles[i]), "window image");
    if (Status s = CreateSemaphore(&images_[i].written); s != Status::Ok) return s;
  }
  for (Slot& slot : slots_)
    if (Status s = CreateSemaphore(&slot.acquired); s != Status::Ok) return s;
  return Status::Ok;
}

Status SwapChain::CreateSemaphore(VkSemaphore* out) {
  const VkSemaphoreCreateInfo info{VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO};
  return core_->Check(core_->vk.vkCreateSemaphore(core_->device, &info, nullptr, out), "", "vkCreateSemaphore");
}

void SwapChain::DestroyChain() {
  fit_ = Fit::Broken;
  if (!chain_) return;
  const VolkDeviceTable& vk = core_->vk;
  vk.vkDeviceWaitIdle(core_->device);
  // First the chain: what it shows may still wait for a semaphore.
  vk.vkDestroySwapchainKHR(core_->device, chain_, nullptr);
  for (const Image& image : images_) vk.vkDestroySemaphore(core_->device, image.written, nullptr);
  for (const Slot& slot : slots_) vk.vkDestroySemaphore(core_->device, slot.acquired, nullptr);
  chain_ = VK_NULL_HANDLE;
  images_.clear();
  slots_.clear();
}

}  // namespace rhi_vulkan
