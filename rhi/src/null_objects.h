// Objects of the null device: what they are made of, in the CPU's memory.
#pragma once

#include <memory>
#include <tuple>
#include <vector>

#include "rhi/backend/checks.h"
#include "rhi/null.h"

namespace rhi::null_backend {

// What the objects share; outlives the device while an object does.
struct Core;
using CorePtr = std::shared_ptr<Core>;

class Buffer final : public backend::Object<IBuffer> {
 public:
  Buffer(const BufferDesc& d, const void* init) : desc_(d), bytes(d.byteWidth) {
    SetName(d.name);
    if (init) std::copy_n(static_cast<const std::byte*>(init), bytes.size(), bytes.begin());
  }
  Usage GetUsage() const override { return desc_.usage; }
  const BufferDesc& Desc() const override { return desc_; }
  void SetName(const char* name) override {
    Object::SetName(name);
    desc_.name = Name().c_str();
  }

 private:
  BufferDesc desc_;

 public:
  std::vector<std::byte> bytes;
  bool mapped = false;
};

// Texels of each subresource, tightly packed; one texel for all samples.
class Texture final : public backend::Object<ITexture> {
 public:
  Texture(const TextureDesc&, const SubresourceData* init);
  Usage GetUsage() const override { return desc_.usage; }
  const TextureDesc& Desc() const override { return desc_; }
  void SetName(const char* name) override {
    Object::SetName(name);
    desc_.name = Name().c_str();
  }
  uint32_t SubresourceCount() const { return uint32_t(texels.size()); }
  backend::MipLayout Layout(uint32_t subresource) const {
    return backend::GetMipLayout(desc_, subresource % desc_.mipLevels);
  }

 private:
  TextureDesc desc_;

 public:
  std::vector<std::vector<std::byte>> texels;
  std::vector<bool> mapped;
};

template <class Interface>
class View final : public backend::Object<Interface> {
 public:
  View(IResource* resource, const ViewDesc& desc) : resource_(resource), desc_(desc) {}
  IResource* Resource() const override { return resource_.get(); }
  const ViewDesc& Desc() const override { return desc_; }

 private:
  Ref<IResource> resource_;
  ViewDesc desc_;
};

class Shader final : public backend::Object<IShader> {
 public:
  explicit Shader(const ShaderBlob& blob) : reflection(blob.reflection), stage_(blob.stage) { SetName(blob.name); }
  Stage GetStage() const override { return stage_; }
  const ShaderReflection reflection;

 private:
  Stage stage_;
};

class InputLayout final : public backend::Object<IInputLayout> {};

template <class Interface, class D>
class State final : public backend::Object<Interface> {
 public:
  State(const CorePtr& core, const D& desc) : core_(core), desc_(desc) {}
  ~State() override;
  const D& Desc() const override { return desc_; }

 private:
  CorePtr core_;
  const D desc_;
};
using BlendState = State<IBlendState, BlendDesc>;
using DepthStencilState = State<IDepthStencilState, DepthStencilDesc>;
using RasterizerState = State<IRasterizerState, RasterizerDesc>;
using SamplerState = State<ISamplerState, SamplerDesc>;

class Query final : public backend::Object<IQuery> {
 public:
  explicit Query(QueryType type) : type_(type) {}
  QueryType Type() const override { return type_; }
  bool active = false, ended = false;

 private:
  QueryType type_;
};

struct Core {
  explicit Core(IMessageSink* sink) : log(sink) {}
  backend::MessageLog log;
  Caps caps;
  std::tuple<backend::Interner<BlendDesc, BlendState>, backend::Interner<DepthStencilDesc, DepthStencilState>,
             backend::Interner<RasterizerDesc, RasterizerState>, backend::Interner<SamplerDesc, SamplerState>>
      states;
};

template <class Interface, class D>
State<Interface, D>::~State() {
  std::get<backend::Interner<D, State>>(core_->states).Forget(this);
}

Buffer* AsBuffer(IResource*);
Texture* AsTexture(IResource*);

// One texel of `format` from linear floats, as a clear stores it; 0 bytes: the null device does not know how.
// Depth-stencil formats: depth in rgba[0], stencil in rgba[1].
uint32_t EncodeTexel(Format, const float rgba[4], std::byte out[16]);

}  // namespace rhi::null_backend
