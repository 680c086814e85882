// A back buffer of our own, an ordinary texture, that Present brings to the default framebuffer of a window, turned
// over: row 0 of a texture is its top, that of a default framebuffer is its bottom.
#pragma once

#include "resources.h"

namespace rhi_gl {

class SwapChain final : public Object<ISwapChain> {
 public:
  static Status Create(const CorePtr&, const SwapChainDesc&, Ref<ISwapChain>* out);
  ~SwapChain() override;

  ITexture* BackBuffer() override { return backBuffer_.get(); }
  Status Present() override;
  Status Resize(uint32_t width, uint32_t height) override;

 private:
  SwapChain(const CorePtr& core, const SwapChainDesc& desc) : core_(core), desc_(desc) {}
  Status OpenSurface();
  Status CreateBackBuffer(uint32_t width, uint32_t height);
  Status LoseSurface();

  CorePtr core_;
  SwapChainDesc desc_;
  void* surface_ = nullptr;  // of EglContext
  Ref<ITexture> backBuffer_;
  GLuint framebuffer_ = 0;  // that reads the back buffer
  bool minimised_ = false, lost_ = false;
};

}  // namespace rhi_gl
