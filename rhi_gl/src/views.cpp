#include "resources.h"

namespace rhi_gl {
namespace {

bool IsWhole(const Texture& t, const ViewDesc& v) {
  return v.format == t.Desc().format && v.firstMip == 0 && v.mipCount == t.Desc().mipLevels && v.firstSlice == 0 &&
         v.sliceCount == backend::SliceCount(t.Desc());
}

Status CheckAlignment(const Core& core, const BufferDesc& desc, const ViewDesc& v) {
  const uint64_t offset = uint64_t(v.firstElement) * desc.structureStride;
  if (offset % core.limits.storageAlignment == 0) return Status::Ok;
  core.log.Report(Severity::Error, MsgCode::CapMissing, desc.name,
                  "the view starts at byte %llu; this adapter wants multiples of %u",
                  static_cast<unsigned long long>(offset), core.limits.storageAlignment);
  return Status::Unsupported;
}

template <class V>
Ref<V> NewView(const CorePtr& core, IResource* resource, const ViewDesc& desc) {
  auto view = Ref<V>::Adopt(new V);
  view->core = core;
  view->resource = Ref<IResource>(resource);
  view->desc = desc;
  view->uid = core->NewUid();
  return view;
}

template <class V>
Status MakeBufferView(const CorePtr& core, Buffer* buffer, const ViewDesc* wanted, Bind need, Ref<V>* out) {
  ViewDesc desc;
  if (Status s = ResolveBufferView(buffer->Desc(), wanted, need, &desc, core->log); s != Status::Ok) return s;
  if (Status s = CheckAlignment(*core, buffer->Desc(), desc); s != Status::Ok) return s;
  *out = NewView<V>(core, buffer, desc);
  (*out)->buffer = buffer;
  (*out)->stride = buffer->Desc().structureStride;
  return Status::Ok;
}

void UseGlView(ViewData& v, bool asArray) {
  v.target = asArray ? GLenum(GL_TEXTURE_2D_ARRAY) : GLenum(GL_NONE);
  v.name = MakeGlView(*v.texture, v.desc.format, v.desc.firstMip, v.desc.mipCount, v.desc.firstSlice, v.desc.sliceCount,
                      &v.target);
  v.owned = true;
}

// What shaders sample or write: the texture itself where the view shows all of it.
template <class V>
Status MakeTextureView(const CorePtr& core, Texture* texture, const ViewDesc* wanted, Bind need, Ref<V>* out) {
  ViewDesc desc;
  if (Status s = ResolveTextureView(texture->Desc(), wanted, need, &desc, core->log); s != Status::Ok) return s;
  *out = NewView<V>(core, texture, desc);
  V& view = **out;
  view.texture = texture;
  view.name = texture->name;
  view.target = texture->target;
  // HLSL has no RWTextureCube: what is written is an array of six slices.
  const bool writableCube = need == Bind::UnorderedAccess && texture->Desc().dim == TextureDim::TexCube;
  if (!IsWhole(*texture, desc) || writableCube) UseGlView(view, writableCube);
  return Status::Ok;
}

// Targets attach the texture at a level and layer; only another format, or a part of the slices, needs a GL view.
template <class V>
Status MakeTargetView(const CorePtr& core, Texture* texture, const ViewDesc* wanted, Bind need, Ref<V>* out) {
  ViewDesc desc;
  if (Status s = ResolveTextureView(texture->Desc(), wanted, need, &desc, core->log); s != Status::Ok) return s;
  *out = NewView<V>(core, texture, desc);
  V& view = **out;
  const TextureDesc& t = texture->Desc();
  const bool all = desc.sliceCount == backend::SliceCount(t);
  view.texture = texture;
  view.name = texture->name;
  view.target = texture->target;
  view.layered = desc.sliceCount > 1 || t.dim == TextureDim::Tex3D;
  view.level = desc.firstMip;
  view.layer = desc.firstSlice;
  if (desc.format == t.format && (all || desc.sliceCount == 1)) return Status::Ok;
  UseGlView(view, false);
  view.level = view.layer = 0;
  return Status::Ok;
}

Status NoResource(const Core& core) {
  core.log.Report(Severity::Error, MsgCode::InvalidDesc, "", "a view needs a resource; it is null");
  return Status::InvalidArg;
}

}  // namespace

ViewData::~ViewData() {
  if (!core) return;
  core->framebuffers.Forget(uid);
  if (owned) core->Discard(NameKind::Texture, name);
}

GLuint MakeGlView(const Texture& t, Format format, uint32_t firstMip, uint32_t mipCount, uint32_t firstSlice,
                  uint32_t sliceCount, GLenum* target) {
  if (*target == GL_NONE)
    *target = t.target == GL_TEXTURE_CUBE_MAP && sliceCount != 6 ? GLenum(GL_TEXTURE_2D_ARRAY) : t.target;
  GLuint name = 0;
  glGenTextures(1, &name);  // glTextureView wants a name without an object
  glTextureView(name, *target, t.name, GetGlFormat(format).internal, firstMip, mipCount, firstSlice, sliceCount);
  return name;
}

Status CreateShaderResourceView(const CorePtr& core, IResource* resource, const ViewDesc* desc,
                                Ref<IShaderResourceView>* out) {
  if (!resource) return NoResource(*core);
  Ref<ShaderResourceView> view;
  Buffer* buffer = AsBuffer(resource);
  const Status s = buffer ? MakeBufferView(core, buffer, desc, Bind::ShaderResource, &view)
                          : MakeTextureView(core, AsTexture(resource), desc, Bind::ShaderResource, &view);
  if (s == Status::Ok) *out = view;
  return s;
}

Status CreateUnorderedAccessView(const CorePtr& core, IResource* resource, const ViewDesc* desc,
                                 Ref<IUnorderedAccessView>* out) {
  if (!resource) return NoResource(*core);
  Ref<UnorderedAccessView> view;
  Buffer* buffer = AsBuffer(resource);
  const Status s = buffer ? MakeBufferView(core, buffer, desc, Bind::UnorderedAccess, &view)
                          : MakeTextureView(core, AsTexture(resource), desc, Bind::UnorderedAccess, &view);
  if (s == Status::Ok) *out = view;
  return s;
}

Status CreateRenderTargetView(const CorePtr& core, ITexture* texture, const ViewDesc* desc,
                              Ref<IRenderTargetView>* out) {
  if (!texture) return NoResource(*core);
  Ref<RenderTargetView> view;
  const Status s = MakeTargetView(core, AsTexture(texture), desc, Bind::RenderTarget, &view);
  if (s == Status::Ok) *out = view;
  return s;
}

Status CreateDepthStencilView(const CorePtr& core, ITexture* texture, const ViewDesc* desc,
                              Ref<IDepthStencilView>* out) {
  if (!texture) return NoResource(*core);
  Ref<DepthStencilView> view;
  const Status s = MakeTargetView(core, AsTexture(texture), desc, Bind::DepthStencil, &view);
  if (s == Status::Ok) *out = view;
  return s;
}

}  // namespace rhi_gl
