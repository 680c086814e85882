#include "shell_pass.h"

#include <algorithm>

#include "fur_shaders/fur_shaders.h"

namespace fur {
namespace {

// As shaders_hlsl/fur_point.hlsli: what the geometry shader emits for each triangle at a time.
constexpr uint32_t kShellsInGs = 14, kVaryingScalars = 24;

const rhi::ShaderBlob& PixelShader(Look look, Semantics semantics, bool between) {
  const bool seed = look == Look::Seed, volume = semantics == Semantics::Volume;
  if (between)
    return seed ? (volume ? shaders::shell_PSMain_between_seed_volume : shaders::shell_PSMain_between_seed)
                : (volume ? shaders::shell_PSMain_between_volume : shaders::shell_PSMain_between);
  return seed ? (volume ? shaders::shell_PSMain_seed_volume : shaders::shell_PSMain_seed)
              : (volume ? shaders::shell_PSMain_volume : shaders::shell_PSMain);
}

}  // namespace

Result<Done> CheckShellMode(const rhi::Caps& caps, const RenderSettings& settings) {
  if (settings.shellMode != ShellMode::Amplified || !settings.drawShells) return Done{};
  const std::string adapter = caps.adapter.data();
  if (!caps.geometryShader)
    return Error{ErrorCode::NoDevice, "shells by amplification need a geometry shader, which " + adapter +
                                          " does not have; draw them instanced"};
  const uint32_t vertices = 3 * kShellsInGs, scalars = vertices * kVaryingScalars;
  if (vertices > caps.maxGSOutputVertices || scalars > caps.maxGSOutputComponents)
    return Error{ErrorCode::NoDevice,
                 "shells by amplification emit " + std::to_string(vertices) + " vertices of " +
                     std::to_string(kVaryingScalars) + " scalars, " + std::to_string(scalars) + " in all; " + adapter +
                     " allows " + std::to_string(caps.maxGSOutputVertices) + " vertices and " +
                     std::to_string(caps.maxGSOutputComponents) + " scalars; draw them instanced"};
  return Done{};
}

ShellPass::ShellPass(Creation& c, const RenderSettings& settings)
    : mode_(settings.shellMode), backFaces_(settings.backFaces) {
  const bool amplified = mode_ == ShellMode::Amplified && settings.drawShells;
  vs_ = c.Shader(amplified ? shaders::shell_amplify_VSMain : shaders::shell_VSMain);
  if (amplified) gs_ = c.Shader(shaders::shell_amplify_GSMain);
  onSlicesPS_ = c.Shader(PixelShader(settings.look, settings.semantics, false));
  betweenPS_ = c.Shader(PixelShader(settings.look, settings.semantics, true));
  layout_ = FurLayout(c, vs_.get());
}

void ShellPass::Draw(rhi::IContext& context, const PassBinding& binding, const GpuModel& model, const FrameInputs& in,
                     size_t animal) const {
  context.IASetInputLayout(layout_.get());
  context.IASetPrimitiveTopology(rhi::PrimitiveTopology::TriangleList);
  if (backFaces_) DrawSide(context, binding, model, in, animal, true);
  DrawSide(context, binding, model, in, animal, false);
  context.GSSetShader(nullptr);
}

void ShellPass::DrawSide(rhi::IContext& context, const PassBinding& binding, const GpuModel& model,
                         const FrameInputs& in, size_t animal, bool back) const {
  for (const GpuPart& part : model.parts) {
    const GpuMaterial& material = model.materials[part.material];
    const GpuFurMesh& mesh = model.furMeshes[part.primitive];
    if (mesh.indexCount == 0) continue;
    PassBinding::SetShaders(context, in, vs_.get(), gs_.get(), (material.betweenSlices ? betweenPS_ : onSlicesPS_).get());
    context.RSSetState(binding.Cull(part, back ? rhi::CullMode::Front : rhi::CullMode::Back));
    binding.SetMaterial(context, material);
    PassBinding::SetVertices(context, mesh.vertices.get(), sizeof(FurVertex), mesh.indices.get());
    binding.SetObject(context, in, in.placements[animal], part);
    DrawShells(context, binding, mesh, material.shells, back, in.counts);
  }
}

// From behind the outermost shell comes first, from the front the innermost.
void ShellPass::DrawShells(rhi::IContext& context, const PassBinding& binding, const GpuFurMesh& mesh, uint32_t shells,
                           bool back, FrameCounts* counts) const {
  const uint32_t atOnce = mode_ == ShellMode::Draws ? 1 : mode_ == ShellMode::Amplified ? kShellsInGs : shells;
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
