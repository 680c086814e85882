// The technique of the four descriptions as published (docs/seed.md): solid pass, fins by a geometry shader over line
// adjacency, 16 instanced shells inside out; animals in the order given; nothing skipped.
#include <cstddef>

#include "driver_error.h"
#include "fur_shaders/fur_shaders.h"
#include "technique.h"

namespace fur {
namespace {

struct Shaders {
  rhi::Ref<rhi::IShader> baseVS, basePS, finVS, finGS, finPS, shellVS, shellPS;
};

struct States {
  rhi::Ref<rhi::IRasterizerState> cullBack, cullBackMirrored, cullNone;
  rhi::Ref<rhi::IDepthStencilState> depthWrite, depthRead;
  rhi::Ref<rhi::IBlendState> opaque, alpha;
};

// Collects the first failure of a series of creations.
class Creation {
 public:
  explicit Creation(rhi::IDevice& device) : device_(device) {}
  rhi::IDevice& Device() { return device_; }
  void Check(rhi::Status status, const char* what) {
    if (status == rhi::Status::Ok || failed_) return;
    failed_ = true;
    error_ = DriverError(status, std::string("cannot create ") + what);
  }
  bool Failed() const { return failed_; }
  const Error& Failure() const { return error_; }

 private:
  rhi::IDevice& device_;
  bool failed_ = false;
  Error error_;
};

rhi::Ref<rhi::IShader> Shader(Creation& c, const rhi::ShaderBlob& blob) {
  rhi::Ref<rhi::IShader> shader;
  c.Check(c.Device().CreateShader(blob, &shader), blob.name);
  return shader;
}

Shaders MakeShaders(Creation& c, Look look, Semantics semantics) {
  const bool seed = look == Look::Seed, volume = semantics == Semantics::Volume;
  const rhi::ShaderBlob& shellPS = seed ? (volume ? shaders::shell_PSMain_seed_volume : shaders::shell_PSMain_seed)
                                        : (volume ? shaders::shell_PSMain_volume : shaders::shell_PSMain);
  Shaders s;
  s.baseVS = Shader(c, shaders::base_VSMain);
  s.basePS = Shader(c, seed ? shaders::base_PSMain_seed : shaders::base_PSMain);
  s.finVS = Shader(c, seed ? shaders::fin_VSMain_seed : shaders::fin_VSMain);
  s.finGS = Shader(c, seed ? shaders::fin_GSMain_seed : shaders::fin_GSMain);
  s.finPS = Shader(c, seed ? shaders::fin_PSMain_seed : shaders::fin_PSMain);
  s.shellVS = Shader(c, shaders::shell_VSMain);
  s.shellPS = Shader(c, shellPS);
  return s;
}

rhi::Ref<rhi::IRasterizerState> Raster(Creation& c, rhi::CullMode cull, bool frontCCW) {
  rhi::Ref<rhi::IRasterizerState> state;
  c.Check(c.Device().CreateRasterizerState({.cull = cull, .frontCCW = frontCCW, .multisample = true}, &state), "a rasterizer state");
  return state;
}

States MakeStates(Creation& c) {
  States s;
  s.cullBack = Raster(c, rhi::CullMode::Back, true);  // glTF: counter-clockwise is front
  s.cullBackMirrored = Raster(c, rhi::CullMode::Back, false);
  s.cullNone = Raster(c, rhi::CullMode::None, true);
  c.Check(c.Device().CreateDepthStencilState({}, &s.depthWrite), "a depth state");
  c.Check(c.Device().CreateDepthStencilState({.depthWrite = false}, &s.depthRead), "a depth state");
  c.Check(c.Device().CreateBlendState({}, &s.opaque), "a blend state");
  rhi::BlendDesc alpha;
  alpha.rt[0] = {.enable = true, .src = rhi::Blend::SrcAlpha, .dest = rhi::Blend::InvSrcAlpha,
                 .srcAlpha = rhi::Blend::SrcAlpha, .destAlpha = rhi::Blend::InvSrcAlpha};
  c.Check(c.Device().CreateBlendState(alpha, &s.alpha), "a blend state");
  return s;
}

rhi::Ref<rhi::IInputLayout> Layout(Creation& c, rhi::IShader* vs) {
  using rhi::Format;
  constexpr rhi::InputElement kElements[] = {
      {.semantic = "POSITION", .format = Format::RGB32_Float, .offset = offsetof(Vertex, position)},
      {.semantic = "NORMAL", .format = Format::RGB32_Float, .offset = offsetof(Vertex, normal)},
      {.semantic = "TANGENT", .format = Format::RGBA32_Float, .offset = offsetof(Vertex, tangent)},
      {.semantic = "TEXCOORD", .format = Format::RG32_Float, .offset = offsetof(Vertex, uv)}};
  rhi::Ref<rhi::IInputLayout> layout;
  if (vs) c.Check(c.Device().CreateInputLayout(kElements, uint32_t(std::size(kElements)), vs, &layout), "the vertex layout");
  return layout;
}

rhi::Ref<rhi::IBuffer> DynamicConstants(Creation& c, size_t bytes, const char* name) {
  rhi::Ref<rhi::IBuffer> buffer;
  c.Check(c.Device().CreateBuffer({.byteWidth = uint32_t(bytes), .usage = rhi::Usage::Dynamic,
                                   .bind = rhi::Bind::ConstantBuffer, .name = name}, nullptr, &buffer),
          name);
  return buffer;
}

rhi::Ref<rhi::ISamplerState> VolumeSampler(Creation& c) {
  rhi::SamplerDesc desc;
  desc.u = desc.v = rhi::AddressMode::Wrap;
  rhi::Ref<rhi::ISamplerState> sampler;
  c.Check(c.Device().CreateSamplerState(desc, &sampler), "a sampler");
  return sampler;
}

FrameConstants MakeFrameConstants(const FrameInputs& in) {
  FrameConstants f{};
  f.eyeWorld = glm::vec4(in.eye, 1);
  f.lightDirection = glm::vec4(glm::normalize(in.light.direction), 0);
  f.lightDiffuse = glm::vec4(in.light.diffuse, 1);
  f.lightAmbient = glm::vec4(in.light.ambient, 1);
  f.lightSpecular = glm::vec4(in.light.specular, 1);
  return f;
}

class SeedTechnique final : public ITechnique {
 public:
  SeedTechnique(Creation& c, const RenderSettings& settings)
      : settings_(settings),
        shaders_(MakeShaders(c, settings.look, settings.semantics)),
        states_(MakeStates(c)),
        layout_(Layout(c, shaders_.baseVS.get())),
        frameConstants_(DynamicConstants(c, sizeof(FrameConstants), "frame constants")),
        objectConstants_(DynamicConstants(c, sizeof(ObjectConstants), "object constants")),
        volumeSampler_(VolumeSampler(c)) {}

  void Draw(rhi::IContext& context, const GpuModel& model, const FrameInputs& in) override {
    BindFrame(context, in);
    RunPass(context, in, Pass::Base, [&] { DrawBase(context, model, in); });
    if (settings_.drawFins && model.firstFur >= 0) RunPass(context, in, Pass::Fins, [&] { DrawFins(context, model, in); });
    if (settings_.drawShells) RunPass(context, in, Pass::Shells, [&] { DrawShells(context, model, in); });
  }

 private:
  template <class F>
  static void RunPass(rhi::IContext& context, const FrameInputs& in, Pass pass, F draw) {
    constexpr const char* kNames[kPassCount] = {"base", "fins", "shells"};
    rhi::IQuery* query = in.passQueries.empty() ? nullptr : in.passQueries[size_t(pass)].get();
    context.BeginEvent(kNames[size_t(pass)]);
    if (query) context.Begin(query);
    draw();
    if (query) context.End(query);
    context.EndEvent();
  }

  void BindFrame(rhi::IContext& context, const FrameInputs& in) {
    const FrameConstants frame = MakeFrameConstants(in);
    context.UpdateConstants(frameConstants_.get(), &frame, sizeof frame);
    rhi::IBuffer* const buffers[] = {frameConstants_.get(), nullptr, objectConstants_.get()};
    context.SetConstantBuffers(0, 3, buffers);
    context.IASetInputLayout(layout_.get());
  }

  static void SetShaders(rhi::IContext& context, const FrameInputs& in, const rhi::Ref<rhi::IShader>& vs, rhi::IShader* gs,
                         const rhi::Ref<rhi::IShader>& ps) {
    context.VSSetShader(vs.get());
    context.GSSetShader(gs);
    context.PSSetShader(in.countingShader ? in.countingShader : ps.get());
  }

  void SetMaterial(rhi::IContext& context, const GpuMaterial& m) const {
    rhi::IBuffer* const constants[] = {m.constants.get()};
    context.SetConstantBuffers(1, 1, constants);
    rhi::IShaderResourceView* const views[] = {m.baseColor.get(), m.normal.get(), m.specular.get(), m.lengthMap.get(),
                                               m.furVolume.get()};
    rhi::ISamplerState* const samplers[] = {m.surfaceSampler.get(), volumeSampler_.get()};
    for (const rhi::Stage stage : {rhi::Stage::Vertex, rhi::Stage::Geometry, rhi::Stage::Pixel}) {
      context.SetShaderResources(stage, 0, 5, views);
      context.SetSamplers(stage, 0, 2, samplers);
    }
  }

  void SetGeometry(rhi::IContext& context, const GpuGeometry& g, rhi::IBuffer* indices) const {
    rhi::IBuffer* const buffers[] = {g.vertices.get()};
    const uint32_t strides[] = {sizeof(Vertex)}, offsets[] = {0};
    context.IASetVertexBuffers(0, 1, buffers, strides, offsets);
    context.IASetIndexBuffer(indices, rhi::Format::R32_UInt, 0);
  }

  void SetObject(rhi::IContext& context, const FrameInputs& in, const glm::dmat4& placement, const GpuPart& part) const {
    const ObjectConstants o = MakeObjectConstants(placement * part.transform, in);
    context.UpdateConstants(objectConstants_.get(), &o, sizeof o);
  }

  rhi::IRasterizerState* FaceState(const GpuPart& part) const {
    return (part.mirrored ? states_.cullBackMirrored : states_.cullBack).get();
  }

  void DrawBase(rhi::IContext& context, const GpuModel& model, const FrameInputs& in) {
    SetShaders(context, in, shaders_.baseVS, nullptr, shaders_.basePS);
    context.IASetPrimitiveTopology(rhi::PrimitiveTopology::TriangleList);
    context.OMSetBlendState(states_.opaque.get());
    context.OMSetDepthStencilState(states_.depthWrite.get());
    for (const glm::dmat4& placement : in.placements)
      for (const GpuPart& part : model.parts) {
        const GpuMaterial& material = model.materials[part.material];
        const GpuGeometry& g = model.geometry[part.primitive];
        context.RSSetState(material.doubleSided ? states_.cullNone.get() : FaceState(part));
        SetMaterial(context, material);
        SetGeometry(context, g, g.indices.get());
        SetObject(context, in, placement, part);
        context.DrawIndexed(g.indexCount, 0, 0);
        ++in.counts->draws;
        in.counts->triangles += g.indexCount / 3;
      }
  }

  // Look seed keeps the demo's fins on bald parts too, drawn with the furred material's maps.
  const GpuMaterial* FinMaterial(const GpuModel& model, const GpuPart& part) const {
    const GpuMaterial& own = model.materials[part.material];
    if (own.shells > 0) return &own;
    return settings_.look == Look::Seed ? &model.materials[size_t(model.firstFur)] : nullptr;
  }

  void DrawFins(rhi::IContext& context, const GpuModel& model, const FrameInputs& in) {
    SetShaders(context, in, shaders_.finVS, shaders_.finGS.get(), shaders_.finPS);
    context.IASetPrimitiveTopology(rhi::PrimitiveTopology::LineListAdj);
    BeginBlending(context);
    for (const glm::dmat4& placement : in.placements)
      for (const GpuPart& part : model.parts) {
        const GpuMaterial* material = FinMaterial(model, part);
        const GpuGeometry& g = model.geometry[part.primitive];
        if (!material || g.finIndexCount == 0) continue;
        context.RSSetState(FaceState(part));
        SetMaterial(context, *material);
        SetGeometry(context, g, g.finIndices.get());
        SetObject(context, in, placement, part);
        context.DrawIndexed(g.finIndexCount, 0, 0);
        ++in.counts->draws;
        in.counts->edges += g.finIndexCount / 4;
      }
    context.GSSetShader(nullptr);
  }

  void DrawShells(rhi::IContext& context, const GpuModel& model, const FrameInputs& in) {
    SetShaders(context, in, shaders_.shellVS, nullptr, shaders_.shellPS);
    context.IASetPrimitiveTopology(rhi::PrimitiveTopology::TriangleList);
    BeginBlending(context);
    for (const glm::dmat4& placement : in.placements)
      for (const GpuPart& part : model.parts) {
        const GpuMaterial& material = model.materials[part.material];
        const GpuGeometry& g = model.geometry[part.primitive];
        if (material.shells == 0) continue;
        context.RSSetState(FaceState(part));
        SetMaterial(context, material);
        SetGeometry(context, g, g.indices.get());
        SetObject(context, in, placement, part);
        context.DrawIndexedInstanced(g.indexCount, material.shells, 0, 0, 0);
        ++in.counts->draws;
        in.counts->triangles += uint64_t(g.indexCount / 3) * material.shells;
      }
  }

  void BeginBlending(rhi::IContext& context) const {
    context.OMSetBlendState(states_.alpha.get());
    context.OMSetDepthStencilState(states_.depthRead.get());
  }

  RenderSettings settings_;
  Shaders shaders_;
  States states_;
  rhi::Ref<rhi::IInputLayout> layout_;
  rhi::Ref<rhi::IBuffer> frameConstants_, objectConstants_;
  rhi::Ref<rhi::ISamplerState> volumeSampler_;
};

}  // namespace

ObjectConstants MakeObjectConstants(const glm::dmat4& objectToWorld, const FrameInputs& in) {
  glm::dmat4 objectToEye = objectToWorld;
  objectToEye[3] -= glm::dvec4(in.eye, 0);
  ObjectConstants o{};
  o.objectToClip = in.worldToClip * objectToWorld;
  o.objectToEye = objectToEye;
  o.normalToWorld = glm::dmat4(glm::transpose(glm::inverse(glm::dmat3(objectToWorld))));
  return o;
}

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
