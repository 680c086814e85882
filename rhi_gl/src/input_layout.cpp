#include <strings.h>

#include "formats.h"
#include "shaders.h"

namespace rhi_gl {
namespace {

const InputElement* FindElement(const InputElement* elements, uint32_t count, const ShaderInput& input) {
  for (uint32_t i = 0; i < count; ++i)
    if (elements[i].semanticIndex == input.semanticIndex && strcasecmp(elements[i].semantic, input.semantic) == 0)
      return &elements[i];
  return nullptr;
}

Status Mismatch(const Core& core, Status status, const char* semantic, uint32_t index, const char* what) {
  core.log.Report(Severity::Error, MsgCode::LayoutMismatch, "", "%s%u: %s", semantic, index, what);
  return status;
}

}  // namespace

Status InputLayout::Create(const CorePtr& core, const InputElement* elements, uint32_t count, IShader* vs,
                           Ref<IInputLayout>* out) {
  const auto* shader = static_cast<Shader*>(vs);
  if (!shader || shader->stage != Stage::Vertex || count > kMaxVertexElements) {
    core->log.Report(Severity::Error, MsgCode::LayoutMismatch, "",
                     "an input layout needs a vertex shader and at most %u elements (%u given)", kMaxVertexElements,
                     count);
    return Status::InvalidArg;
  }
  auto layout = Ref<InputLayout>::Adopt(new InputLayout(core));
  layout->array.uid = core->NewUid();
  glCreateVertexArrays(1, &layout->array.name);
  for (const ShaderInput& input : shader->reflection.inputs) {
    const InputElement* element = FindElement(elements, count, input);
    if (!element)
      return Mismatch(*core, Status::InvalidArg, input.semantic, input.semanticIndex,
                      "the shader reads it and the layout has no such element");
    if (Status s = layout->AddElement(*element, input.location); s != Status::Ok) return s;
  }
  *out = layout;
  return Status::Ok;
}

InputLayout::~InputLayout() { core_->Discard(NameKind::VertexArray, array.name); }

Status InputLayout::CheckElement(const InputElement& e) const {
  const auto refuse = [&](Status s, const char* what) {
    return Mismatch(*core_, s, e.semantic, e.semanticIndex, what);
  };
  if (e.slot >= kMaxVertexBuffers) return refuse(Status::InvalidArg, "its slot is beyond the last vertex buffer slot");
  if (GetGlFormat(e.format).attribSize == 0)
    return refuse(Status::Unsupported, "its format is no vertex format; see CheckFormatSupport");
  if (e.offset > core_->limits.maxAttribOffset) return refuse(Status::Unsupported, "its offset exceeds GL's limit");
  if (e.inputClass == InputClass::PerInstance && e.stepRate == 0)
    return refuse(Status::InvalidArg, "a PerInstance element needs a stepRate of at least 1");
  const InputElement* other = slotElements_[e.slot];
  if (other && (other->inputClass != e.inputClass || other->stepRate != e.stepRate))
    return refuse(Status::InvalidArg, "all elements of one slot need one class and step rate, as in Direct3D 10");
  return Status::Ok;
}

Status InputLayout::AddElement(const InputElement& e, uint32_t location) {
  if (Status s = CheckElement(e); s != Status::Ok) return s;
  const GlFormat& f = GetGlFormat(e.format);
  glEnableVertexArrayAttrib(array.name, location);
  glVertexArrayAttribBinding(array.name, location, e.slot);
  if (GetFormatInfo(e.format).isInteger) {
    glVertexArrayAttribIFormat(array.name, location, f.attribSize, f.attribType, e.offset);
  } else {
    glVertexArrayAttribFormat(array.name, location, f.attribSize, f.attribType, f.normalized, e.offset);
  }
  glVertexArrayBindingDivisor(array.name, e.slot, e.inputClass == InputClass::PerInstance ? e.stepRate : 0);
  slotElements_[e.slot] = &e;
  attributeMask |= 1u << location;
  array.slotMask |= 1u << e.slot;
  return Status::Ok;
}

}  // namespace rhi_gl
