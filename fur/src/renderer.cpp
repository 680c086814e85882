#include "fur/renderer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/packing.hpp>
#include <optional>

#include "creation.h"
#include "finite.h"
#include "fur_shaders/fur_shaders.h"
#include "presets.h"
#include "skin_pass.h"
#include "targets.h"
#include "technique.h"

namespace fur {
namespace {

// Half floats lose up to 2^-11 of the value at every shell (llvmpipe cuts off), which 32 shells keep below 1/255.
constexpr uint32_t kMostShellsInHalf = 32;

// The most shells that a material of the model is drawn with.
uint32_t MostShells(const GpuModel& model) {
  uint32_t most = 0;
  for (const GpuMaterial& m : model.materials) most = std::max(most, m.shells);
  return most;
}

TargetFormat ResolveTarget(const RenderSettings& s, uint32_t shells) {
  if (s.target != TargetFormat::Auto) return s.target;
  if (s.technique == Technique::Seed) return TargetFormat::Unorm8;
  return shells > kMostShellsInHalf ? TargetFormat::Float32 : TargetFormat::Float16;
}

float HalfToFloat(uint16_t h) { return glm::unpackHalf1x16(h); }

// Brings a frame of floats to the picture's eight bits, through its one transfer function.
class Presenter {
 public:
  Presenter(Creation& c, const RenderSettings& s, rhi::ITexture* frame)
      : width_(s.width),
        height_(s.height),
        vs_(c.Shader(shaders::present_VSMain)),
        ps_(c.Shader(s.look == Look::Correct ? shaders::present_PSMain_srgb : shaders::present_PSMain)),
        raster_(c.Raster(rhi::CullMode::None, false)),
        depth_(c.Depth({.depthEnable = false, .depthWrite = false})),
        blend_(c.Blend(rhi::Blend::One, rhi::Blend::Zero)) {
    c.Check(c.Device().CreateTexture({.width = s.width, .height = s.height, .format = rhi::Format::RGBA8_UNorm,
                                      .bind = rhi::Bind::RenderTarget, .name = "picture"},
                                     nullptr, &picture_),
            "the picture");
    if (picture_) c.Check(c.Device().CreateRenderTargetView(picture_.get(), nullptr, &target_), "the picture's view");
    if (frame) c.Check(c.Device().CreateShaderResourceView(frame, nullptr, &frame_), "the frame's view");
  }
  void Draw(rhi::IContext& context) const {
    rhi::IRenderTargetView* const targets[] = {target_.get()};
    rhi::IShaderResourceView* frame = frame_.get();
    context.OMSetRenderTargets(1, targets, nullptr);
    context.IASetInputLayout(nullptr);
    context.IASetPrimitiveTopology(rhi::PrimitiveTopology::TriangleList);
    context.VSSetShader(vs_.get());
    context.GSSetShader(nullptr);
    context.PSSetShader(ps_.get());
    context.RSSetState(raster_.get());
    context.OMSetDepthStencilState(depth_.get());
    context.OMSetBlendState(blend_.get());
    const rhi::Viewport viewport{.width = float(width_), .height = float(height_)};
    context.RSSetViewports(1, &viewport);
    context.PSSetShaderResources(0, 1, &frame);
    context.Draw(3, 0);
    frame = nullptr;
    context.PSSetShaderResources(0, 1, &frame);  // the next frame draws to it
  }
  rhi::ITexture* Picture() const { return picture_.get(); }

 private:
  uint32_t width_, height_;
  rhi::Ref<rhi::IShader> vs_, ps_;
  rhi::Ref<rhi::IRasterizerState> raster_;
  rhi::Ref<rhi::IDepthStencilState> depth_;
  rhi::Ref<rhi::IBlendState> blend_;
  rhi::Ref<rhi::ITexture> picture_;
  rhi::Ref<rhi::IRenderTargetView> target_;
  rhi::Ref<rhi::IShaderResourceView> frame_;
};

class RendererImpl final : public Renderer {
 public:
  RendererImpl(rhi::IDevice& device, const RenderSettings& settings) : device_(device), settings_(settings) {}

  Result<Done> Init(const Model& model) {
    if (Result<Done> ok = CheckPreset(device_.GetCaps(), settings_); !ok) return ok.error();
    if (Result<Done> ok = CheckSkinSamples(settings_); !ok) return ok.error();
    if (Result<Done> ok = CheckModel(model); !ok) return ok.error();
    Result<GpuModel> uploaded = UploadModel(device_, model, settings_);
    if (!uploaded) return uploaded.error();
    model_ = std::move(*uploaded);
    settings_.target = ResolveTarget(settings_, MostShells(model_));
    rhi::Status status = MakeTargets(device_, settings_, settings_.samples, &targets_);
    if (status == rhi::Status::Ok) status = MakeResolved();
    if (status != rhi::Status::Ok) return DriverError(status, "cannot create the targets");
    Result<std::unique_ptr<ITechnique>> technique = settings_.technique == Technique::Seed
                                                        ? MakeSeedTechnique(device_, settings_)
                                                        : MakeShellsTechnique(device_, settings_);
    if (!technique) return technique.error();
    technique_ = std::move(*technique);
    if (settings_.target == TargetFormat::Unorm8) return Done{};
    Creation creation(device_);
    presenter_.emplace(creation, settings_, resolved_.get());
    if (creation.Failed()) return creation.Failure();
    return Done{};
  }

  void Draw(const Camera& camera, std::span<const glm::dmat4> placements, const Motion& motion) override {
    FrameCounts counts;
    const FrameInputs in = Inputs(camera, placements, motion, &counts);
    DrawInto(targets_, in);
    if (settings_.samples > 1)
      Context().ResolveSubresource(resolved_.get(), 0, targets_.color.get(), 0, targets_.format);
    if (presenter_) presenter_->Draw(Context());
    Context().EndFrame();
  }

  Result<Done> Finish() override {
    const rhi::Status status = device_.WaitIdle();
    if (status != rhi::Status::Ok) return DriverError(status, "the driver failed while drawing");
    return Done{};
  }

  Result<Image> ReadImage() override {
    Image image{"frame", settings_.width, settings_.height, {}};
    image.pixels.resize(size_t(image.width) * image.height * 4);
    rhi::ITexture* picture = presenter_ ? presenter_->Picture() : resolved_.get();
    const rhi::Status status = device_.ReadBack(picture, 0, image.pixels.data(), image.pixels.size());
    if (status != rhi::Status::Ok) return DriverError(status, "cannot read the frame back");
    for (size_t i = 3; i < image.pixels.size(); i += 4) image.pixels[i] = 255;
    return image;
  }

  Result<FloatImage> ReadPixels() override {
    if (!presenter_)
      return Error{ErrorCode::Usage, "a frame of 8 bits has no float pixels; choose a Float16 or Float32 target"};
    FloatImage image{settings_.width, settings_.height, {}};
    image.pixels.resize(size_t(image.width) * image.height);
    const bool half = targets_.format == rhi::Format::RGBA16_Float;
    std::vector<uint16_t> halves(half ? image.pixels.size() * 4 : 0);
    void* const out = half ? static_cast<void*>(halves.data()) : image.pixels.data();
    const size_t bytes = image.pixels.size() * (half ? 8 : 16);
    const rhi::Status status = device_.ReadBack(resolved_.get(), 0, out, bytes);
    if (status != rhi::Status::Ok) return DriverError(status, "cannot read the frame back");
    for (size_t i = 0; i < halves.size(); ++i) image.pixels[i / 4][int(i % 4)] = HalfToFloat(halves[i]);
    return image;
  }

  Result<FrameCounts> Count(const Camera& camera, std::span<const glm::dmat4> placements) override {
    FrameCounts counts;
    Targets targets;
    std::array<rhi::Ref<rhi::IQuery>, kPassCount> queries;
    rhi::Ref<rhi::IShader> counting;
    rhi::Status status = MakeTargets(device_, settings_, 1, &targets);
    if (status == rhi::Status::Ok) status = device_.CreateShader(shaders::count_PSMain, &counting);
    for (auto& q : queries)
      if (status == rhi::Status::Ok) status = device_.CreateQuery({rhi::QueryType::Occlusion}, &q);
    if (status != rhi::Status::Ok) return DriverError(status, "cannot prepare the counting pass");

    FrameInputs in = Inputs(camera, placements, Motion{}, &counts);
    in.countingShader = counting.get();
    in.passQueries = queries;
    DrawInto(targets, in);
    Context().EndFrame();
    if (Result<Done> finished = Finish(); !finished) return finished.error();
    counts.baseFragments = ReadCount(queries[size_t(Pass::Base)].get());
    if (settings_.drawFins && model_.firstFur >= 0) counts.finFragments = ReadCount(queries[size_t(Pass::Fins)].get());
    if (settings_.drawShells) counts.shellFragments = ReadCount(queries[size_t(Pass::Shells)].get());
    return counts;
  }

 private:
  rhi::IContext& Context() { return *device_.ImmediateContext(); }

  rhi::Status MakeResolved() {
    resolved_ = targets_.color;
    if (settings_.samples == 1) return rhi::Status::Ok;
    return device_.CreateTexture({.width = settings_.width, .height = settings_.height, .format = targets_.format,
                                  .bind = rhi::Bind::RenderTarget | rhi::Bind::ShaderResource, .name = "resolved"},
                                 nullptr, &resolved_);
  }

  FrameInputs Inputs(const Camera& camera, std::span<const glm::dmat4> placements, const Motion& motion,
                     FrameCounts* counts) {
    FrameInputs in;
    in.eye = camera.eye;
    in.worldToClip = ProjectionMatrix(camera, double(settings_.width) / settings_.height) * ViewMatrix(camera);
    in.light = settings_.light;
    in.placements = placements;
    in.motion = motion;
    const double time = settings_.time + motion.time;
    in.motion.time = std::isfinite(time) ? time : 0;
    in.counts = counts;
    // A camera that is nowhere sees nothing.
    if (!IsFinite(in.worldToClip)) in.placements = {};
    KeepFinite(&in);
    return in;
  }

  // An animal that is nowhere, or that a number without meaning moves, is not drawn.
  void KeepFinite(FrameInputs* in) {
    const size_t animals = in->placements.size();
    const auto isFinite = [in](size_t i) { return IsFinite(in->placements[i]) && IsFinite(in->OffsetOf(i)); };
    size_t finite = 0;
    while (finite < animals && isFinite(finite)) ++finite;
    if (finite == animals) return;
    finitePlacements_.clear();
    finiteOffsets_.clear();
    for (size_t i = 0; i < animals; ++i) {
      if (!isFinite(i)) continue;
      finitePlacements_.push_back(in->placements[i]);
      finiteOffsets_.push_back(in->OffsetOf(i));
    }
    in->counts->skippedAnimals += animals - finitePlacements_.size();
    in->placements = finitePlacements_;
    in->motion.offsets = finiteOffsets_;
  }

  void DrawInto(const Targets& targets, FrameInputs in) {
    rhi::IContext& context = Context();
    // Techniques that blend premultiplied leave the opacity of what they drew in alpha.
    const glm::vec4 background(settings_.background, settings_.technique == Technique::Seed ? 1 : 0);
    in.targets = &targets;
    BindTargets(context, targets);
    ClearTargets(context, targets, background);
    const rhi::Viewport viewport{.width = float(settings_.width), .height = float(settings_.height)};
    context.RSSetViewports(1, &viewport);
    technique_->Draw(context, model_, in);
  }

  uint64_t ReadCount(rhi::IQuery* query) {
    uint64_t samples = 0;
    return Context().GetData(query, &samples, sizeof samples, true) == rhi::Status::Ok ? samples : 0;
  }

  rhi::IDevice& device_;
  RenderSettings settings_;
  Targets targets_;
  rhi::Ref<rhi::ITexture> resolved_;  // at one sample the targets' colour itself
  GpuModel model_;
  std::unique_ptr<ITechnique> technique_;
  std::optional<Presenter> presenter_;
  std::vector<glm::dmat4> finitePlacements_;  // where not all are
  std::vector<glm::dvec3> finiteOffsets_;
};

}  // namespace

Result<std::unique_ptr<Renderer>> MakeRenderer(rhi::IDevice& device, const Model& model, const RenderSettings& settings) {
  auto renderer = std::make_unique<RendererImpl>(device, settings);
  if (Result<Done> made = renderer->Init(model); !made) return made.error();
  return std::unique_ptr<Renderer>(std::move(renderer));
}

}  // namespace fur
