#include "shell_pass.h"

#include <algorithm>

#include "fur_shaders/fur_shaders.h"

namespace fur {
namespace {

// The most that the geometry shader emits for each triangle, by its own word (shaders_hlsl/fur_point.hlsli).
uint32_t ShellsInGs() { return shaders::shell_amplify_GSMain.reflection.gsMaxVertices / 3; }
uint32_t VaryingScalars() { return shaders::shell_amplify_GSMain.reflection.gsOutputComponents; }

constexpr uint32_t kVolumeSlot = 4, kTintSlot = 8;  // fur_volume.hlsli
constexpr uint32_t kFirstSlot = 5;  // sorted: t5: vertices, t6: order, t7: indices

// By + 1: look seed, + 2: volume, + 4: between slices, + 8: groomed.
const rhi::ShaderBlob* const kPixelShaders[16] = {
    &shaders::shell_PSMain, &shaders::shell_PSMain_seed,
    &shaders::shell_PSMain_volume, &shaders::shell_PSMain_seed_volume,
    &shaders::shell_PSMain_between, &shaders::shell_PSMain_between_seed,
    &shaders::shell_PSMain_between_volume, &shaders::shell_PSMain_between_seed_volume,
    &shaders::shell_PSMain_groom, &shaders::shell_PSMain_seed_groom,
    &shaders::shell_PSMain_volume_groom, &shaders::shell_PSMain_seed_volume_groom,
    &shaders::shell_PSMain_between_groom, &shaders::shell_PSMain_between_seed_groom,
    &shaders::shell_PSMain_between_volume_groom, &shaders::shell_PSMain_between_seed_volume_groom};

// Look correct. By + 1: volume, + 2: between slices, + 4: groomed.
const rhi::ShaderBlob* const kTintedShaders[8] = {
    &shaders::shell_PSMain_tint, &shaders::shell_PSMain_volume_tint,
    &shaders::shell_PSMain_between_tint, &shaders::shell_PSMain_between_volume_tint,
    &shaders::shell_PSMain_groom_tint, &shaders::shell_PSMain_volume_groom_tint,
    &shaders::shell_PSMain_between_groom_tint, &shaders::shell_PSMain_between_volume_groom_tint};

}  // namespace

Result<Done> CheckShellMode(const rhi::Caps& caps, const RenderSettings& settings) {
  if (settings.shellMode != ShellMode::Amplified || !settings.drawShells) return Done{};
  if (settings.shellsAtOnce < 1 || settings.shellsAtOnce > ShellsInGs())
    return Error{ErrorCode::Usage, "a geometry shader makes 1 to " + std::to_string(ShellsInGs()) +
                                       " shells of a triangle at once, not " + std::to_string(settings.shellsAtOnce)};
  const std::string adapter = caps.adapter.data();
  if (!caps.geometryShader)
    return Error{ErrorCode::NoDevice, "shells by amplification need a geometry shader, which " + adapter +
                                          " does not have; draw them instanced"};
  const uint32_t vertices = 3 * ShellsInGs(), scalars = vertices * VaryingScalars();
  if (vertices > caps.maxGSOutputVertices || scalars > caps.maxGSOutputComponents)
    return Error{ErrorCode::NoDevice,
                 "shells by amplification emit " + std::to_string(vertices) + " vertices of " +
                     std::to_string(VaryingScalars()) + " scalars, " + std::to_string(scalars) + " in all; " + adapter +
                     " allows " + std::to_string(caps.maxGSOutputVertices) + " vertices and " +
                     std::to_string(caps.maxGSOutputComponents) + " scalars; draw them instanced"};
  return Done{};
}

ShellPass::ShellPass(Creation& c, const RenderSettings& settings)
    : mode_(settings.shellMode), backFaces_(settings.backFaces), shellsAtOnce_(settings.shellsAtOnce) {
  const bool amplified = mode_ == ShellMode::Amplified && settings.drawShells, sorted = mode_ == ShellMode::Sorted;
  vs_.still = c.Shader(amplified ? shaders::shell_amplify_VSMain : sorted ? shaders::shell_sorted_VSMain : shaders::shell_VSMain);
  vs_.swaying = amplified ? vs_.still : c.Shader(sorted ? shaders::shell_sorted_VSMain_sway : shaders::shell_VSMain_sway);
  if (amplified) gs_ = {c.Shader(shaders::shell_amplify_GSMain), c.Shader(shaders::shell_amplify_GSMain_sway)};
  const size_t seed = settings.look == Look::Seed ? 1 : 0, volume = settings.semantics == Semantics::Volume ? 1 : 0;
  for (size_t i = 0; i < 4; ++i) {
    ps_[i] = c.Shader(*kPixelShaders[seed + 2 * volume + 4 * i]);
    if (!seed) ps_[4 + i] = c.Shader(*kTintedShaders[volume + 2 * i]);  // look seed has none
  }
  if (!sorted) layout_ = FurLayout(c, vs_.still.get());
}

void ShellPass::Draw(rhi::IContext& context, const PassBinding& binding, const GpuModel& model, const FrameInputs& in,
                     size_t animal) const {
  context.IASetInputLayout(layout_.get());
  context.IASetPrimitiveTopology(rhi::PrimitiveTopology::TriangleList);
  if (mode_ == ShellMode::Sorted) return DrawSorted(context, binding, model, in, animal);
  const std::vector<rhi::IBuffer*> indices = Indices(context, model, in, animal);  // once for both sides
  if (backFaces_) DrawSide(context, binding, model, in, {animal, indices, true});
  DrawSide(context, binding, model, in, {animal, indices, false});
  context.GSSetShader(nullptr);
}

namespace {

// Where an animal's part is seen from, and how its fur leans in the mean; in the part's axes.
struct Seen {
  glm::dvec3 eye, lean;
};
Seen From(const FrameInputs& in, size_t animal, const GpuPart& part, const GpuMaterial& material) {
  const FurSway sway = PartSway(in, animal, part, material);
  return {glm::dvec3(glm::inverse(in.placements[animal] * part.transform) * glm::dvec4(in.eye, 1)),
          sway.comb + sway.gravity + sway.wind * 0.5};
}

// What Map gives of a dynamic buffer of 32-bit numbers; null where this frame has no memory for it.
uint32_t* Write(rhi::IContext& context, rhi::IBuffer* buffer) {
  rhi::Mapped mapped;
  const bool ok = context.Map(buffer, 0, rhi::MapMode::WriteDiscard, &mapped) == rhi::Status::Ok;
  return ok ? static_cast<uint32_t*>(mapped.data) : nullptr;
}

}  // namespace

// For each part what its triangles are drawn from. One shell at a time is drawn in the list's order, as instances are:
// where two limbs overlap, another order would show.
std::vector<rhi::IBuffer*> ShellPass::Indices(rhi::IContext& context, const GpuModel& model, const FrameInputs& in,
                                              size_t animal) const {
  std::vector<rhi::IBuffer*> indices;
  for (const GpuPart& part : model.parts) {
    const GpuFurMesh& mesh = model.furMeshes[part.primitive];
    indices.push_back(mesh.indices.get());
    uint32_t* out = part.sortedIndices ? Write(context, part.sortedIndices.get()) : nullptr;
    if (!out) continue;
    const Seen seen = From(in, animal, part, model.materials[part.material]);
    for (const uint32_t triangle : mesh.order.BackToFront(seen.eye, seen.lean))
      out = std::copy_n(&mesh.cpuIndices[size_t{3} * triangle], 3, out);
    context.Unmap(part.sortedIndices.get(), 0);
    indices.back() = part.sortedIndices.get();
  }
  return indices;
}

void ShellPass::DrawSorted(rhi::IContext& context, const PassBinding& binding, const GpuModel& model,
                           const FrameInputs& in, size_t animal) const {
  for (const GpuPart& part : model.parts) {
    const GpuFurMesh& mesh = model.furMeshes[part.primitive];
    const GpuMaterial& material = model.materials[part.material];
    uint32_t* out = part.order ? Write(context, part.order.get()) : nullptr;
    if (!out) continue;
    const Seen seen = From(in, animal, part, material);
    for (const uint32_t triangle : mesh.order.BackToFront(seen.eye, seen.lean))
      *out++ = 2 * triangle + (mesh.order.SeenFromBehind(triangle, seen.eye, seen.lean, material.length) ? 1 : 0);
    context.Unmap(part.order.get(), 0);
    BindPart(context, binding, model, in, animal, part, backFaces_ ? rhi::CullMode::None : rhi::CullMode::Back);
    rhi::IShaderResourceView* const views[] = {mesh.verticesView.get(), part.orderView.get(), mesh.indicesView.get()};
    context.VSSetShaderResources(kFirstSlot, 3, views);
    binding.SetDraw(context, {0, 1, material.shells, 0});
    context.Draw(mesh.indexCount * material.shells, 0);
    ++in.counts->draws;
    in.counts->triangles += uint64_t(mesh.indexCount / 3) * material.shells;
  }
  rhi::IShaderResourceView* const nothing[] = {nullptr, nullptr, nullptr};
  context.VSSetShaderResources(kFirstSlot, 3, nothing);  // the next frame's compaction writes to t7
}

void ShellPass::BindPart(rhi::IContext& context, const PassBinding& binding, const GpuModel& model,
                         const FrameInputs& in, size_t animal, const GpuPart& part, rhi::CullMode cull) const {
  const GpuMaterial& material = model.materials[part.material];
  const size_t shader = (material.betweenSlices ? 1u : 0u) + (material.groomed ? 2u : 0u) + (material.tinted ? 4u : 0u);
  PassBinding::SetShaders(context, in, vs_.For(material), gs_.For(material), ps_[shader].get());
  context.RSSetState(binding.Cull(in.placements[animal], part, cull));
  binding.SetMaterial(context, material);
  rhi::IShaderResourceView *const volume = material.shellVolume.get(), *const tint = material.shellTint.get();
  context.PSSetShaderResources(kVolumeSlot, 1, &volume);
  context.PSSetShaderResources(kTintSlot, 1, &tint);
  binding.SetObject(context, in, animal, part, material);
}

void ShellPass::DrawSide(rhi::IContext& context, const PassBinding& binding, const GpuModel& model,
                         const FrameInputs& in, const Side& side) const {
  for (size_t i = 0; i < model.parts.size(); ++i) {
    const GpuPart& part = model.parts[i];
    const GpuFurMesh& mesh = model.furMeshes[part.primitive];
    if (mesh.indexCount == 0) continue;
    BindPart(context, binding, model, in, side.animal, part, side.back ? rhi::CullMode::Front : rhi::CullMode::Back);
    PassBinding::SetVertices(context, mesh.vertices.get(), sizeof(FurVertex), side.indices[i]);
    DrawShells(context, binding, mesh, model.materials[part.material].shells, side.back, in.counts);
  }
}

// From behind the outermost shell comes first, from the front the innermost.
void ShellPass::DrawShells(rhi::IContext& context, const PassBinding& binding, const GpuFurMesh& mesh, uint32_t shells,
                           bool back, FrameCounts* counts) const {
  const uint32_t atOnce = mode_ == ShellMode::Draws ? 1 : mode_ == ShellMode::Amplified ? shellsAtOnce_ : shells;
  for (uint32_t done = 0; done < shells; done += atOnce) {
    const uint32_t count = std::min(atOnce, shells - done);
    binding.SetDraw(context, {back ? shells - 1 - done : done, back ? -1 : 1, count, 0});
    const uint32_t instances = mode_ == ShellMode::Instanced ? count : 1;
    context.DrawIndexedInstanced(mesh.indexCount, instances, 0, 0, 0);
    ++counts->draws;
    counts->triangles += uint64_t(mesh.indexCount / 3) * instances;
  }
}

}  // namespace fur
