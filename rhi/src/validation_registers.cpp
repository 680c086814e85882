// What the shaders of a draw or dispatch read, against what is bound.
#include "validation_context.h"

namespace rhi::validation {
namespace {

const char* ToString(TextureDim dim) {
  constexpr auto kNames = std::to_array<const char*>({"Tex2D", "Tex2DArray", "TexCube", "Tex3D", "Tex2DMS"});
  return size_t(dim) < kNames.size() ? kNames[size_t(dim)] : "no TextureDim";
}

bool IsWritten(const ShaderResource& r) {
  return r.kind == ShaderResourceKind::RWTexture || r.kind == ShaderResourceKind::RWStructuredBuffer;
}

bool IsTexture(const ShaderResource& r) {
  return r.kind == ShaderResourceKind::Texture || r.kind == ShaderResourceKind::RWTexture;
}

}  // namespace

bool Context::CheckRegisters(const char* call, Stage stage) {
  const IShader* shader = state_.shaders[size_t(stage)].get();
  if (!shader) return true;
  const ShaderReflection& reflection = v_.objects.Find(shader)->shader;
  for (const ShaderConstantBuffer& c : reflection.constantBuffers)
    if (!CheckConstants(call, stage, *shader, c)) return false;
  for (const ShaderResource& r : reflection.resources)
    if (!CheckResource(call, stage, *shader, r)) return false;
  for (const ShaderSampler& s : reflection.samplers)
    if (s.slot < kMaxSamplers && !state_.samplers[size_t(stage)][s.slot])
      v_.Warn(MsgCode::NothingBound, {shader, s.name},
              "%s: s%u (%s) of the %s shader has no sampler; Direct3D's default is used; call SetSamplers", call,
              uint32_t(s.slot), s.name, rhi::ToString(stage));
  return true;
}

bool Context::CheckConstants(const char* call, Stage stage, const IShader& shader, const ShaderConstantBuffer& c) {
  if (c.slot >= kMaxConstantBuffers) return true;  // the backend refused the shader
  const IBuffer* buffer = state_.constants[c.slot].get();
  if (!buffer)
    return v_.Warn(MsgCode::NothingBound, {&shader, c.name},
                   "%s: b%u (%s) of the %s shader has no buffer; it reads 0; call SetConstantBuffers", call,
                   uint32_t(c.slot), c.name, rhi::ToString(stage));
  const uint32_t size = (buffer->Desc().byteWidth + 15) / 16 * 16;  // registers are read whole
  return size >= c.byteWidth ||
         v_.Error(
             MsgCode::ConstantsTooSmall, buffer,
             "%s: b%u (%s) of the %s shader has %u bytes, the buffer bound there %u; make it larger; it is skipped",
             call, uint32_t(c.slot), c.name, rhi::ToString(stage), c.byteWidth, buffer->Desc().byteWidth);
}

bool Context::CheckResource(const char* call, Stage stage, const IShader& shader, const ShaderResource& r) {
  const bool written = IsWritten(r);
  if (r.slot >= (written ? kMaxUnorderedAccess : kMaxShaderResources)) return true;
  const IView* view = nullptr;
  if (written) {
    view = state_.uavs[r.slot].get();
  } else {
    view = state_.resources[size_t(stage)][r.slot].get();
  }
  if (view) return CheckView(call, shader, r, *view);
  return v_.Warn(MsgCode::NothingBound, {&shader, r.name},
                 "%s: %c%u (%s) of the %s shader has no view; it reads 0; call %s", call, written ? 'u' : 't',
                 uint32_t(r.slot), r.name, rhi::ToString(stage),
                 written ? "CSSetUnorderedAccessViews" : "SetShaderResources");
}

bool Context::CheckView(const char* call, const IShader& shader, const ShaderResource& r, const IView& view) {
  const IResource* resource = view.Resource();
  const char letter = IsWritten(r) ? 'u' : 't';
  if (IsTexture(r) == IsBuffer(resource))
    return v_.Error(MsgCode::ViewMismatch, {&shader, r.name},
                    "%s: %c%u (%s) is declared as a %s, but a view of the %s '%s' is bound; it is skipped", call,
                    letter, uint32_t(r.slot), r.name, IsTexture(r) ? "texture" : "structured buffer",
                    IsTexture(r) ? "buffer" : "texture", Name(resource));
  if (!IsTexture(r)) {
    const uint32_t stride = static_cast<const IBuffer*>(resource)->Desc().structureStride;
    return stride == r.stride ||
           v_.Error(
               MsgCode::StrideMismatch, {&shader, r.name},
               "%s: an element of %c%u (%s) has %u bytes, one of the bound buffer '%s' has %u; make structureStride "
               "the size of the shader's struct; it is skipped",
               call, letter, uint32_t(r.slot), r.name, r.stride, Name(resource), stride);
  }
  const TextureDesc& desc = static_cast<const ITexture*>(resource)->Desc();
  const TextureDim dim = backend::ShownDim(desc, view.Desc(), IsWritten(r));
  if (dim != r.dim)
    return v_.Error(MsgCode::ViewMismatch, {&shader, r.name},
                    "%s: %c%u (%s) is declared as %s, but the bound '%s' is %s; make the texture of that dim; it is "
                    "skipped",
                    call, letter, uint32_t(r.slot), r.name, ToString(r.dim), Name(resource), ToString(dim));
  const Format format = view.Desc().format;
  return GetFormatInfo(format).isInteger == r.integer ||
         v_.Error(MsgCode::ViewMismatch, {&shader, r.name},
                  "%s: %c%u (%s) is declared with %s texels, but the bound '%s' is %s; it is skipped", call, letter,
                  uint32_t(r.slot), r.name, r.integer ? "integer" : "float", Name(resource), rhi::ToString(format));
}

}  // namespace rhi::validation
