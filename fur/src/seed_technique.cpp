// The technique of the four descriptions as published (docs/seed.md): solid pass, fins by a geometry shader over line
// adjacency, 16 instanced shells inside out; animals in the order given; nothing skipped.
#include "fur_shaders/fur_shaders.h"
#include "pass.h"

namespace fur {
namespace {

struct Shaders {
  rhi::Ref<rhi::IShader> finVS, finGS, finPS, shellVS, shellPS;
};

Shaders MakeShaders(Creation& c, Look look, Semantics semantics) {
  const bool seed = look == Look::Seed, volume = semantics == Semantics::Volume;
  Shaders s;
  s.finVS = c.Shader(seed ? shaders::seed_fin_VSMain_seed : shaders::seed_fin_VSMain);
  s.finGS = c.Shader(seed ? shaders::seed_fin_GSMain_seed : shaders::seed_fin_GSMain);
  s.finPS = c.Shader(seed ? shaders::seed_fin_PSMain_seed : shaders::seed_fin_PSMain);
  s.shellVS = c.Shader(shaders::seed_shell_VSMain);
  s.shellPS = c.Shader(seed ? (volume ? shaders::seed_shell_PSMain_seed_volume : shaders::seed_shell_PSMain_seed)
                            : (volume ? shaders::seed_shell_PSMain_volume : shaders::seed_shell_PSMain));
  return s;
}

class SeedTechnique final : public ITechnique {
 public:
  SeedTechnique(Creation& c, const RenderSettings& settings)
      : settings_(settings),
        binding_(c),
        base_(c, settings.look),
        shaders_(MakeShaders(c, settings.look, settings.semantics)),
        layout_(ModelLayout(c, shaders_.shellVS.get())),
        alpha_(c.Blend(rhi::Blend::SrcAlpha, rhi::Blend::InvSrcAlpha)) {}

  void Draw(rhi::IContext& context, const GpuModel& model, const FrameInputs& in) override {
    binding_.BindFrame(context, in);
    RunPass(context, in, Pass::Base, [&] { base_.Draw(context, binding_, model, in); });
    context.IASetInputLayout(layout_.get());
    if (settings_.drawFins && model.firstFur >= 0) RunPass(context, in, Pass::Fins, [&] { DrawFins(context, model, in); });
    if (settings_.drawShells) RunPass(context, in, Pass::Shells, [&] { DrawShells(context, model, in); });
  }

 private:
  // Look seed keeps the demo's fins on bald parts too, drawn with the furred material's maps.
  const GpuMaterial* FinMaterial(const GpuModel& model, const GpuPart& part) const {
    const GpuMaterial& own = model.materials[part.material];
    if (own.shells > 0) return &own;
    return settings_.look == Look::Seed ? &model.materials[size_t(model.firstFur)] : nullptr;
  }

  void DrawFins(rhi::IContext& context, const GpuModel& model, const FrameInputs& in) {
    PassBinding::SetShaders(context, in, shaders_.finVS.get(), shaders_.finGS.get(), shaders_.finPS.get());
    context.IASetPrimitiveTopology(rhi::PrimitiveTopology::LineListAdj);
    BeginBlending(context);
    for (const glm::dmat4& placement : in.placements)
      for (const GpuPart& part : model.parts) {
        const GpuMaterial* material = FinMaterial(model, part);
        const GpuGeometry& g = model.geometry[part.primitive];
        if (!material || g.finIndexCount == 0) continue;
        context.RSSetState(binding_.Cull(part, rhi::CullMode::Back));
        binding_.SetMaterial(context, *material);
        PassBinding::SetVertices(context, g.vertices.get(), sizeof(Vertex), g.finIndices.get());
        binding_.SetObject(context, in, placement, part);
        context.DrawIndexed(g.finIndexCount, 0, 0);
        ++in.counts->draws;
        in.counts->edges += g.finIndexCount / 4;
      }
    context.GSSetShader(nullptr);
  }

  void DrawShells(rhi::IContext& context, const GpuModel& model, const FrameInputs& in) {
    PassBinding::SetShaders(context, in, shaders_.shellVS.get(), nullptr, shaders_.shellPS.get());
    context.IASetPrimitiveTopology(rhi::PrimitiveTopology::TriangleList);
    BeginBlending(context);
    for (const glm::dmat4& placement : in.placements)
      for (const GpuPart& part : model.parts) {
        const GpuMaterial& material = model.materials[part.material];
        const GpuGeometry& g = model.geometry[part.primitive];
        if (material.shells == 0) continue;
        context.RSSetState(binding_.Cull(part, rhi::CullMode::Back));
        binding_.SetMaterial(context, material);
        PassBinding::SetVertices(context, g.vertices.get(), sizeof(Vertex), g.indices.get());
        binding_.SetObject(context, in, placement, part);
        context.DrawIndexedInstanced(g.indexCount, material.shells, 0, 0, 0);
        ++in.counts->draws;
        in.counts->triangles += uint64_t(g.indexCount / 3) * material.shells;
      }
  }

  void BeginBlending(rhi::IContext& context) const {
    context.OMSetBlendState(alpha_.get());
    context.OMSetDepthStencilState(binding_.depthRead.get());
  }

  RenderSettings settings_;
  PassBinding binding_;
  BasePass base_;
  Shaders shaders_;
  rhi::Ref<rhi::IInputLayout> layout_;
  rhi::Ref<rhi::IBlendState> alpha_;
};

}  // namespace

Result<std::unique_ptr<ITechnique>> MakeSeedTechnique(rhi::IDevice& device, const RenderSettings& settings) {
  if (settings.drawFins && !device.GetCaps().geometryShader)
    return Error{ErrorCode::NoDevice, "the seed technique raises its fins in a geometry shader, which " +
                                          std::string(device.GetCaps().adapter.data()) + " does not have; try --no-fins"};
  Creation creation(device);
  auto technique = std::make_unique<SeedTechnique>(creation, settings);
  if (creation.Failed()) return creation.Failure();
  return std::unique_ptr<ITechnique>(std::move(technique));
}

}  // namespace fur
