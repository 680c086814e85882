#include <cstring>

#include "resources.h"
#include "transfer.h"

namespace rhi_gl {
namespace {

Status CheckFormat(const Core& core, const TextureDesc& desc) {
  const FormatSupport support = QueryFormatSupport(desc.format, core.caps);
  const char* lacks = nullptr;
  if (!(support & FormatSupport::Texture2D)) lacks = "textures";
  if ((desc.bind & Bind::RenderTarget) && !(support & FormatSupport::RenderTarget)) lacks = "render targets";
  if ((desc.bind & Bind::DepthStencil) && !(support & FormatSupport::DepthStencil)) lacks = "depth-stencil targets";
  if ((desc.bind & Bind::UnorderedAccess) && !(support & FormatSupport::UnorderedAccess)) lacks = "unordered access";
  if (IsCompressed(desc.format) && desc.dim == TextureDim::Tex3D) lacks = "3D textures";
  if (desc.sampleCount > 1 && !SupportsSamples(desc.format, desc.sampleCount)) lacks = "that many samples";
  if (!lacks) return Status::Ok;
  core.log.Report(Severity::Error, MsgCode::CapMissing, desc.name, "%s does not offer %s here; see CheckFormatSupport",
                  ToString(desc.format), lacks);
  return Status::Unsupported;
}

}  // namespace

Texture::Texture(const CorePtr& core, const TextureDesc& desc) : target(TargetOf(desc.dim)), core_(core), desc_(desc) {}

Status Texture::Create(const CorePtr& core, const TextureDesc& wanted, const SubresourceData* init,
                       Ref<ITexture>* out) {
  TextureDesc desc = wanted;
  if (Status s = CheckTextureDesc(&desc, init, core->caps, core->log); s != Status::Ok) return s;
  if (Status s = CheckFormat(*core, desc); s != Status::Ok) return s;
  auto texture = Ref<Texture>::Adopt(new Texture(core, desc));
  bool made = false;
  const bool fits = core->Allocates([&] {
    made = texture->IsStaging() ? texture->AllocateStaging(init) : texture->AllocateStorage();
    if (made && init && !texture->IsStaging()) texture->UploadAll(init);
  });
  if (!fits || !made) return core->OutOfMemory(desc.name, "texture");
  texture->SetName(desc.name);
  *out = texture;
  return Status::Ok;
}

Texture::~Texture() {
  core_->Discard(NameKind::Texture, name);
  core_->Discard(NameKind::Buffer, stagingBuffer);
}

void Texture::SetName(const char* text) {
  Object::SetName(text);
  desc_.name = Name().c_str();
  core_->Label(name ? GL_TEXTURE : GL_BUFFER, name ? name : stagingBuffer, text);
}

bool Texture::AllocateStorage() {
  const GLenum internal = GetGlFormat(desc_.format).internal;
  const GLsizei mips = GLsizei(desc_.mipLevels), w = GLsizei(desc_.width), h = GLsizei(desc_.height);
  glCreateTextures(target, 1, &name);
  uid = core_->NewUid();
  switch (desc_.dim) {
    case TextureDim::Tex2D:
    case TextureDim::TexCube: glTextureStorage2D(name, mips, internal, w, h); break;
    case TextureDim::Tex2DArray:
    case TextureDim::Tex3D: glTextureStorage3D(name, mips, internal, w, h, GLsizei(desc_.depthOrArray)); break;
    case TextureDim::Tex2DMS:
      glTextureStorage2DMultisample(name, GLsizei(desc_.sampleCount), internal, w, h, GL_TRUE);
      break;
  }
  return true;
}

bool Texture::AllocateStaging(const SubresourceData* init) {
  uint64_t size = 0;
  for (uint32_t i = 0; i < SubresourceCount(); ++i) {
    offsets_.push_back(size);
    // Pixel transfers want offsets that are multiples of a component; 16 suits every format.
    size += (Layout(i).sliceBytes * Layout(i).depth + 15) & ~uint64_t(15);
  }
  constexpr GLbitfield kMap = GL_MAP_READ_BIT | GL_MAP_WRITE_BIT | GL_MAP_PERSISTENT_BIT | GL_MAP_COHERENT_BIT;
  glCreateBuffers(1, &stagingBuffer);
  glNamedBufferStorage(stagingBuffer, GLsizeiptr(size), nullptr, kMap | GL_CLIENT_STORAGE_BIT);
  stagingData = static_cast<std::byte*>(glMapNamedBufferRange(stagingBuffer, 0, GLsizeiptr(size), kMap));
  mapped.resize(SubresourceCount());
  if (stagingData && init) UploadAll(init);
  return stagingData != nullptr;
}

void Texture::UploadAll(const SubresourceData* init) {
  for (uint32_t i = 0; i < SubresourceCount(); ++i) {
    const SubresourceData& from = init[i];
    if (!IsStaging()) {
      TexelBlock block;
      MakeBlock(desc_, MipOf(i), SliceOf(i), nullptr, &block);
      Upload(*this, block, from.data, from.rowPitch, from.slicePitch);
      continue;
    }
    const backend::MipLayout m = Layout(i);
    const uint64_t rowPitch = from.rowPitch ? from.rowPitch : m.rowBytes;
    const uint64_t slicePitch = from.slicePitch ? from.slicePitch : rowPitch * m.rows;
    for (uint32_t z = 0; z < m.depth; ++z)
      for (uint32_t y = 0; y < m.rows; ++y)
        std::memcpy(stagingData + offsets_[i] + z * m.sliceBytes + uint64_t(y) * m.rowBytes,
                    static_cast<const std::byte*>(from.data) + z * slicePitch + y * rowPitch, m.rowBytes);
  }
}

}  // namespace rhi_gl
