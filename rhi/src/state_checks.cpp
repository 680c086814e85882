// The checks of state descriptors: every enum is a value of its type, and the adapter has the caps that are asked for.
#include <algorithm>
#include <array>

#include "rhi/backend/checks.h"

namespace rhi::backend {
namespace {

Status Invalid(const MessageLog& log, const char* text) {
  log.Report(Severity::Error, MsgCode::InvalidDesc, "", "%s", text);
  return Status::InvalidArg;
}

Status Lacking(const MessageLog& log, const char* text) {
  log.Report(Severity::Error, MsgCode::CapMissing, "", "%s", text);
  return Status::Unsupported;
}

// Most enums begin at 1, as Direct3D's do.
template <class E>
bool UpTo(E value, E last) {
  return uint32_t(value) >= 1 && value <= last;
}

bool Valid(Comparison c) { return UpTo(c, Comparison::Always); }
bool Valid(AddressMode m) { return UpTo(m, AddressMode::Border); }
bool Valid(Blend f) { return UpTo(f, Blend::InvSrc1Alpha); }
bool Valid(BlendOp op) { return UpTo(op, BlendOp::Max); }
bool Valid(StencilOp op) { return UpTo(op, StencilOp::Decr); }

bool Valid(const RenderTargetBlend& b) {
  return Valid(b.src) && Valid(b.dest) && Valid(b.srcAlpha) && Valid(b.destAlpha) && Valid(b.op) && Valid(b.opAlpha);
}

bool Valid(const StencilFace& f) { return Valid(f.fail) && Valid(f.depthFail) && Valid(f.pass) && Valid(f.func); }

bool UsesSecondSource(const RenderTargetBlend& t) {
  const auto second = [](Blend b) { return b >= Blend::Src1Color; };
  return t.enable && (second(t.src) || second(t.dest) || second(t.srcAlpha) || second(t.destAlpha));
}

bool UsesBorder(const SamplerDesc& d) {
  return d.u == AddressMode::Border || d.v == AddressMode::Border || d.w == AddressMode::Border;
}

// The three colours that every driver has.
bool IsStandardBorder(const std::array<float, 4>& c) {
  return c == std::array{0.0f, 0.0f, 0.0f, 0.0f} || c == std::array{0.0f, 0.0f, 0.0f, 1.0f} ||
         c == std::array{1.0f, 1.0f, 1.0f, 1.0f};
}

}  // namespace

Status CheckBlendDesc(const BlendDesc& d, const Caps& caps, const MessageLog& log) {
  for (const RenderTargetBlend& b : d.rt)
    if (!Valid(b)) return Invalid(log, "a BlendDesc has a factor or operation that is none");
  if (d.independent && !caps.independentBlend)
    return Lacking(log, "BlendDesc::independent needs Caps::independentBlend");
  if (!caps.dualSourceBlend && std::any_of(d.rt.begin(), d.rt.end(), UsesSecondSource))
    return Lacking(log, "blend factors of a second source need Caps::dualSourceBlend");
  return Status::Ok;
}

Status CheckDepthStencilDesc(const DepthStencilDesc& d, const MessageLog& log) {
  if (Valid(d.depthFunc) && Valid(d.front) && Valid(d.back)) return Status::Ok;
  return Invalid(log, "a DepthStencilDesc has a comparison or operation that is none");
}

Status CheckRasterizerDesc(const RasterizerDesc& d, const Caps& caps, const MessageLog& log) {
  const bool fill = d.fill == FillMode::Wireframe || d.fill == FillMode::Solid;
  if (!fill || !UpTo(d.cull, CullMode::Back))
    return Invalid(log, "a RasterizerDesc has a fill or cull mode that is none");
  if (d.fill == FillMode::Wireframe && !caps.wireframe)
    return Lacking(log, "FillMode::Wireframe needs Caps::wireframe");
  if (!d.depthClip && !caps.depthClipDisable) return Lacking(log, "depthClip = false needs Caps::depthClipDisable");
  if (d.depthBiasClamp != 0 && !caps.depthBiasClamp) return Lacking(log, "depthBiasClamp needs Caps::depthBiasClamp");
  return Status::Ok;
}

Status CheckSamplerDesc(const SamplerDesc& d, const Caps& caps, const MessageLog& log) {
  if (!Valid(d.u) || !Valid(d.v) || !Valid(d.w) || !Valid(d.func))
    return Invalid(log, "a SamplerDesc has an address mode or comparison that is none");
  if (d.min > Filter::Anisotropic || d.mag > Filter::Anisotropic || d.mip > Filter::Anisotropic)
    return Invalid(log, "a SamplerDesc has a filter that is none");
  if (d.maxAniso < 1 || d.maxAniso > 16) return Invalid(log, "SamplerDesc::maxAniso must be 1 to 16");
  if (UsesBorder(d) && !IsStandardBorder(d.border) && !caps.customBorderColor)
    return Lacking(log, "this border colour needs Caps::customBorderColor; (0,0,0,0), (0,0,0,1) and (1,1,1,1) do not");
  return Status::Ok;
}

}  // namespace rhi::backend
