#include "fin_pass.h"

#include "fur_shaders/fur_shaders.h"
#include "shell_pass.h"

namespace fur {
namespace {

constexpr uint32_t kFirstSlot = 5;              // t5: vertices, t6: edges, t7: kept edges
constexpr uint64_t kMostKeptBytes = 64u << 20;  // beyond it fins are pulled; the shaders get indices as floats

// By look seed, by volume, then by + 1: groomed, + 2: tinted, which look seed does not have.
const rhi::ShaderBlob* const kPixelShaders[2][2][4] = {
    {{&shaders::fin_PSMain_correct, &shaders::fin_PSMain_correct_groom,
      &shaders::fin_PSMain_correct_tint, &shaders::fin_PSMain_correct_groom_tint},
     {&shaders::fin_PSMain_correct_volume, &shaders::fin_PSMain_correct_groom_volume,
      &shaders::fin_PSMain_correct_tint_volume, &shaders::fin_PSMain_correct_groom_tint_volume}},
    {{&shaders::fin_PSMain_seed, &shaders::fin_PSMain_seed_groom, nullptr, nullptr},
     {&shaders::fin_PSMain_seed_volume, &shaders::fin_PSMain_seed_groom_volume, nullptr, nullptr}}};

bool CanCompact(const rhi::Caps& caps) { return caps.compute && caps.drawIndirect; }

FinMode Resolve(const rhi::Caps& caps, FinMode mode) {
  if (mode != FinMode::Auto) return mode;
  if (CanCompact(caps)) return FinMode::Compacted;
  return caps.geometryShader ? FinMode::Geometry : FinMode::Pulled;
}

}  // namespace

Result<Done> CheckFinMode(const rhi::Caps& caps, const RenderSettings& settings) {
  if (!settings.drawFins) return Done{};
  const std::string adapter = caps.adapter.data();
  if (settings.finMode == FinMode::Geometry && !caps.geometryShader)
    return Error{ErrorCode::NoDevice, "fins by a geometry shader need one, which " + adapter +
                                          " does not have; take --fins pulled or compacted"};
  if (settings.finMode == FinMode::Compacted && !CanCompact(caps))
    return Error{ErrorCode::NoDevice, "compacted fins need compute shaders and indirect draws, which " + adapter +
                                          " does not have; take --fins pulled"};
  return Done{};
}

FinPass::FinPass(Creation& c, const RenderSettings& settings)
    : device_(c.Device()), mode_(Resolve(c.Device().GetCaps(), settings.finMode)) {
  if (!settings.drawFins) return;
  const bool seed = settings.look == Look::Seed, volume = settings.semantics == Semantics::Volume;
  for (size_t i = 0; i < ps_.size(); ++i)
    if (const rhi::ShaderBlob* shader = kPixelShaders[seed][volume][i]) ps_[i] = c.Shader(*shader);
  if (mode_ == FinMode::Geometry) {
    vs_.fill(c.Shader(shaders::fin_VSMain));
    gs_ = {c.Shader(volume ? shaders::fin_GSMain_volume : shaders::fin_GSMain),
           c.Shader(volume ? shaders::fin_GSMain_sway_volume : shaders::fin_GSMain_sway)};
    layout_ = FurLayout(c, vs_[0].get());
    return;
  }
  vs_ = {c.Shader(volume ? shaders::fin_pull_VSMain_volume : shaders::fin_pull_VSMain),
         c.Shader(volume ? shaders::fin_pull_VSMain_sway_volume : shaders::fin_pull_VSMain_sway)};
  if (mode_ == FinMode::Pulled) return;
  compactedVS_ = {c.Shader(volume ? shaders::fin_pull_VSMain_compacted_volume : shaders::fin_pull_VSMain_compacted),
                  c.Shader(volume ? shaders::fin_pull_VSMain_compacted_sway_volume
                                  : shaders::fin_pull_VSMain_compacted_sway)};
  compactCS_ = c.Shader(shaders::fin_compact_CSMain);
}

// False: the list would be too large, or there is no memory for it; the fins are pulled then.
bool FinPass::Reserve(const GpuModel& model, size_t animals) {
  slots_.clear();
  uint64_t edges = 0;
  for (size_t animal = 0; animal < animals; ++animal)
    for (const GpuPart& part : model.parts) {
      slots_.push_back({uint32_t(edges), uint32_t(slots_.size())});
      edges += model.furMeshes[part.primitive].edgeCount;
      if (edges * sizeof(uint32_t) > kMostKeptBytes) return false;
    }
  if (edges == 0) return false;
  if (edges <= keptCapacity_ && arguments_ &&
      arguments_->Desc().byteWidth >= slots_.size() * sizeof(rhi::DrawArgs))
    return true;
  Creation c(device_);
  using rhi::Bind;
  kept_ = c.Buffer({.byteWidth = uint32_t(edges * sizeof(uint32_t)), .bind = Bind::ShaderResource | Bind::UnorderedAccess,
                    .structureStride = sizeof(uint32_t), .name = "kept edges"});
  arguments_ = c.Buffer({.byteWidth = uint32_t(slots_.size() * sizeof(rhi::DrawArgs)),
                         .bind = Bind::IndirectArgs | Bind::UnorderedAccess,
                         .structureStride = sizeof(rhi::DrawArgs), .name = "arguments of fins"});
  if (!c.Failed()) c.Check(device_.CreateShaderResourceView(kept_.get(), nullptr, &keptView_), "a view");
  if (!c.Failed()) c.Check(device_.CreateUnorderedAccessView(kept_.get(), nullptr, &keptUav_), "a view");
  if (!c.Failed()) c.Check(device_.CreateUnorderedAccessView(arguments_.get(), nullptr, &argumentsUav_), "a view");
  keptCapacity_ = c.Failed() ? 0 : edges;
  return !c.Failed();
}

void FinPass::Prepare(rhi::IContext& context, const PassBinding& binding, const GpuModel& model,
                      const FrameInputs& in) {
  compacted_ = mode_ == FinMode::Compacted && Reserve(model, in.placements.size());
  if (compacted_) Compact(context, binding, model, in);
}

void FinPass::Compact(rhi::IContext& context, const PassBinding& binding, const GpuModel& model,
                      const FrameInputs& in) {
  context.BeginEvent("compact fins");
  context.CSSetShader(compactCS_.get());
  rhi::IUnorderedAccessView* const outputs[] = {keptUav_.get(), argumentsUav_.get()};
  context.CSSetUnorderedAccessViews(0, 2, outputs);
  for (size_t animal = 0; animal < in.placements.size(); ++animal)
    for (size_t i = 0; i < model.parts.size(); ++i) {
      const GpuPart& part = model.parts[i];
      const GpuFurMesh& mesh = model.furMeshes[part.primitive];
      if (mesh.edgeCount == 0) continue;
      const Slot& slot = SlotOf(model, animal, i);
      rhi::IShaderResourceView* const inputs[] = {mesh.verticesView.get(), mesh.edgesView.get()};
      context.CSSetShaderResources(kFirstSlot, 2, inputs);
      const GpuMaterial& material = model.materials[part.material];
      binding.SetMaterial(context, material);
      binding.SetObject(context, in, animal, part, material);
      binding.SetDraw(context, {mesh.edgeCount, slot.firstEdge, slot.arguments, 0});
      context.Dispatch(1, 1, 1);
      ++in.counts->dispatches;
    }
  rhi::IUnorderedAccessView* const nothing[] = {nullptr, nullptr};
  context.CSSetUnorderedAccessViews(0, 2, nothing);
  context.EndEvent();
}

void FinPass::Draw(rhi::IContext& context, const PassBinding& binding, const GpuModel& model, const FrameInputs& in,
                   size_t animal) const {
  const bool geometry = mode_ == FinMode::Geometry;
  context.IASetInputLayout(layout_.get());
  context.IASetPrimitiveTopology(geometry ? rhi::PrimitiveTopology::LineListAdj : rhi::PrimitiveTopology::TriangleList);
  for (size_t i = 0; i < model.parts.size(); ++i) {
    const GpuPart& part = model.parts[i];
    const GpuFurMesh& mesh = model.furMeshes[part.primitive];
    if (mesh.edgeCount == 0) continue;
    context.RSSetState(binding.Cull(in.placements[animal], part, rhi::CullMode::None));  // a fin has no back
    const GpuMaterial& material = model.materials[part.material];
    const size_t sways = material.sways, shading = (material.groomed ? 1 : 0) + (material.tinted ? 2 : 0);
    PassBinding::SetShaders(context, in, (compacted_ ? compactedVS_ : vs_)[sways].get(), gs_[sways].get(),
                            ps_[shading].get());
    binding.SetMaterial(context, material);
    binding.SetObject(context, in, animal, part, material);
    DrawPart(context, binding, mesh, geometry || !compacted_ ? Slot{} : SlotOf(model, animal, i));
    ++in.counts->draws;
    in.counts->edges += mesh.edgeCount;
    in.counts->skippedEdges += mesh.baldEdges;
  }
  rhi::IShaderResourceView* const nothing[] = {nullptr, nullptr, nullptr};
  context.VSSetShaderResources(kFirstSlot, 3, nothing);  // the next frame's compaction writes to t7
  context.GSSetShader(nullptr);
}

void FinPass::DrawPart(rhi::IContext& context, const PassBinding& binding, const GpuFurMesh& mesh,
                       const Slot& slot) const {
  if (mode_ == FinMode::Geometry) {
    PassBinding::SetVertices(context, mesh.vertices.get(), sizeof(FurVertex), mesh.edges.get());
    context.DrawIndexed(mesh.edgeCount * 4, 0, 0);
    return;
  }
  rhi::IShaderResourceView* const views[] = {mesh.verticesView.get(), mesh.edgesView.get(),
                                             compacted_ ? keptView_.get() : nullptr};
  context.VSSetShaderResources(kFirstSlot, 3, views);
  binding.SetDraw(context, {0, slot.firstEdge, 0, 0});
  if (compacted_) {
    context.DrawInstancedIndirect(arguments_.get(), slot.arguments * uint32_t(sizeof(rhi::DrawArgs)));
  } else {
    context.Draw(mesh.edgeCount * 6, 0);
  }
}

}  // namespace fur
