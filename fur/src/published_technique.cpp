// The technique of the four descriptions as published (docs/seed.md, docs/presets.md): solid pass, fins by a geometry
// shader over edges, shells inside out; animals in the order given; nothing skipped. presets.h says how each differs.
#include "pass.h"
#include "presets.h"

namespace fur {
namespace {

struct Shaders {
  rhi::Ref<rhi::IShader> finVS, finGS, finPS, shellVS, shellGS, shellPS;
};

Shaders MakeShaders(Creation& c, const PresetShaders& blobs, const RenderSettings& settings) {
  const bool amplified = TraitsOf(settings.preset).shells == ShellMode::Amplified;
  Shaders s;
  s.shellVS = c.Shader(*blobs.shellVS);
  s.shellPS = c.Shader(*blobs.shellPS);
  if (amplified && settings.drawShells) s.shellGS = c.Shader(*blobs.shellGS);
  s.finVS = c.Shader(*blobs.finVS);
  s.finPS = c.Shader(*blobs.finPS);
  if (settings.drawFins) s.finGS = c.Shader(*blobs.finGS);
  return s;
}

class PublishedTechnique final : public ITechnique {
 public:
  PublishedTechnique(Creation& c, const RenderSettings& settings, const PresetShaders& blobs)
      : settings_(settings),
        traits_(TraitsOf(settings.preset)),
        binding_(c, 0),
        base_(c, settings.look, blobs.furredBase),
        shaders_(MakeShaders(c, blobs, settings)),
        layout_(ModelLayout(c, shaders_.shellVS.get())),
        alpha_(c.Blend(rhi::Blend::SrcAlpha, rhi::Blend::InvSrcAlpha)) {}

  void Draw(rhi::IContext& context, const GpuModel& model, const FrameInputs& in) override {
    binding_.BindFrame(context, in);
    RunPass(context, in, Pass::Base, [&] { base_.Draw(context, binding_, model, in); });
    context.IASetInputLayout(layout_.get());
    if (settings_.drawFins && model.firstFur >= 0)
      RunPass(context, in, Pass::Fins, [&] { DrawFins(context, model, in); });
    if (settings_.drawShells) RunPass(context, in, Pass::Shells, [&] { DrawShells(context, model, in); });
  }

 private:
  // Look seed keeps the demo's fins on bald parts too, drawn with the furred material's maps.
  const GpuMaterial* FinMaterial(const GpuModel& model, const GpuPart& part) const {
    const GpuMaterial& own = model.materials[part.material];
    if (own.shells > 0) return &own;
    const bool demo = settings_.preset == Preset::DemoFur && settings_.look == Look::Seed;
    return demo ? &model.materials[size_t(model.firstFur)] : nullptr;
  }

  void DrawFins(rhi::IContext& context, const GpuModel& model, const FrameInputs& in) {
    const uint32_t indicesOfEdge = traits_.fins == rhi::PrimitiveTopology::LineListAdj ? 4 : 2;
    PassBinding::SetShaders(context, in, shaders_.finVS.get(), shaders_.finGS.get(), shaders_.finPS.get());
    context.IASetPrimitiveTopology(traits_.fins);
    BeginBlending(context);
    for (size_t animal = 0; animal < in.placements.size(); ++animal)
      for (const GpuPart& part : model.parts) {
        const GpuMaterial* material = FinMaterial(model, part);
        const GpuGeometry& g = model.geometry[part.primitive];
        if (!material || g.finIndexCount == 0) continue;
        context.RSSetState(binding_.Cull(in.placements[animal], part, traits_.finCull));
        binding_.SetMaterial(context, *material);
        PassBinding::SetVertices(context, g.vertices.get(), sizeof(Vertex), g.finIndices.get());
        binding_.SetObject(context, in, animal, part, *material);
        context.DrawIndexed(g.finIndexCount, 0, 0);
        ++in.counts->draws;
        in.counts->edges += g.finIndexCount / indicesOfEdge;
      }
    context.GSSetShader(nullptr);
  }

  void DrawShells(rhi::IContext& context, const GpuModel& model, const FrameInputs& in) {
    PassBinding::SetShaders(context, in, shaders_.shellVS.get(), shaders_.shellGS.get(), shaders_.shellPS.get());
    context.IASetPrimitiveTopology(rhi::PrimitiveTopology::TriangleList);
    BeginBlending(context);
    for (size_t animal = 0; animal < in.placements.size(); ++animal)
      for (const GpuPart& part : model.parts) {
        const GpuMaterial& material = model.materials[part.material];
        const GpuGeometry& g = model.geometry[part.primitive];
        if (material.shells == 0) continue;
        context.RSSetState(binding_.Cull(in.placements[animal], part, rhi::CullMode::Back));
        binding_.SetMaterial(context, material);
        PassBinding::SetVertices(context, g.vertices.get(), sizeof(Vertex), g.indices.get());
        binding_.SetObject(context, in, animal, part, material);
        in.counts->draws += DrawEachShell(context, g, material.shells);
        // Amplified: submitted once, but that many leave the geometry shader.
        in.counts->triangles += uint64_t(g.indexCount / 3) * material.shells;
      }
    context.GSSetShader(nullptr);
  }

  // Number of draws.
  uint32_t DrawEachShell(rhi::IContext& context, const GpuGeometry& g, uint32_t shells) {
    switch (traits_.shells) {
      case ShellMode::Instanced: context.DrawIndexedInstanced(g.indexCount, shells, 0, 0, 0); return 1;
      case ShellMode::Amplified: context.DrawIndexed(g.indexCount, 0, 0); return 1;
      case ShellMode::Draws:
      case ShellMode::Sorted: break;  // no published system sorts
    }
    for (uint32_t shell = 0; shell < shells; ++shell) {
      binding_.SetDraw(context, glm::vec4(float(shell), 1, 0, 0));
      context.DrawIndexed(g.indexCount, 0, 0);
    }
    return shells;
  }

  void BeginBlending(rhi::IContext& context) const {
    context.OMSetBlendState(alpha_.get());
    context.OMSetDepthStencilState(binding_.depthRead.get());
  }

  RenderSettings settings_;
  const PresetTraits& traits_;
  PassBinding binding_;
  BasePass base_;
  Shaders shaders_;
  rhi::Ref<rhi::IInputLayout> layout_;
  rhi::Ref<rhi::IBlendState> alpha_;
};

}  // namespace

Result<std::unique_ptr<ITechnique>> MakeSeedTechnique(rhi::IDevice& device, const RenderSettings& settings) {
  if (Result<Done> ok = CheckPreset(device.GetCaps(), settings); !ok) return ok.error();
  if (settings.drawFins && !device.GetCaps().geometryShader)
    return Error{ErrorCode::NoDevice, "the seed technique raises its fins in a geometry shader, which " +
                                          std::string(device.GetCaps().adapter.data()) +
                                          " does not have; try --no-fins"};
  Creation creation(device);
  const PresetShaders blobs = ShadersOf(settings, settings.shells);
  auto technique = std::make_unique<PublishedTechnique>(creation, settings, blobs);
  if (creation.Failed()) return creation.Failure();
  return std::unique_ptr<ITechnique>(std::move(technique));
}

}  // namespace fur
