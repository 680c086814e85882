// The technique `shells` (docs/shells.md): shells and fins without the published defects. Bases of all animals, nearest
// first; then the fur of each animal, farthest first: fins, shells seen from behind from the outside in, shells seen from
// the front from the inside out. Blended premultiplied: (1, 1 - alpha).
#include <algorithm>
#include <cstddef>
#include <numeric>

#include "fin_pass.h"
#include "fur_shaders/fur_shaders.h"
#include "pass.h"
#include "shell_pass.h"
#include "skin_pass.h"

namespace fur {
namespace {

class ShellsTechnique final : public ITechnique {
 public:
  ShellsTechnique(Creation& c, const RenderSettings& settings)
      : settings_(settings),
        binding_(c, kVolumeMipBias),
        skin_(c, settings),
        fins_(c, settings),
        shells_(c, settings),
        over_(c.Blend(rhi::Blend::One, rhi::Blend::InvSrcAlpha)) {}

  void Draw(rhi::IContext& context, const GpuModel& model, const FrameInputs& in) override {
    const Animals order = BackToFront(model, in);
    FrameInputs sorted = in;
    sorted.placements = order.placements;
    sorted.motion.offsets = order.offsets;
    binding_.BindFrame(context, in);
    if (settings_.drawFins) fins_.Prepare(context, binding_, model, sorted);
    DrawSkin(context, model, sorted);
    context.OMSetBlendState(over_.get());
    context.OMSetDepthStencilState(binding_.depthRead.get());
    if (in.passQueries.empty()) {
      for (size_t animal = 0; animal < order.placements.size(); ++animal) DrawFur(context, model, sorted, animal, true, true);
    } else {  // what is counted does not depend on the order
      RunPass(context, in, Pass::Fins, [&] { DrawAllFur(context, model, sorted, true); });
      RunPass(context, in, Pass::Shells, [&] { DrawAllFur(context, model, sorted, false); });
    }
  }

 private:
  struct Animals {
    std::vector<glm::dmat4> placements;
    std::vector<glm::dvec3> offsets;
  };

  // By the distance of their middles: all of an animal's layers belong together.
  Animals BackToFront(const GpuModel& model, const FrameInputs& in) const {
    std::vector<size_t> order(in.placements.size());
    std::iota(order.begin(), order.end(), size_t{0});
    const glm::dvec4 center(model.bounds.Center(), 1);
    const auto distance = [&](size_t i) { return glm::length(glm::dvec3(in.placements[i] * center) - in.eye); };
    if (settings_.sortAnimals)
      std::stable_sort(order.begin(), order.end(), [&](size_t a, size_t b) { return distance(a) > distance(b); });
    Animals animals;
    for (const size_t i : order) {
      animals.placements.push_back(in.placements[i]);
      animals.offsets.push_back(in.OffsetOf(i));
    }
    return animals;
  }

  // Nearest first, so that what is hidden is not shaded.
  void DrawSkin(rhi::IContext& context, const GpuModel& model, const FrameInputs& sorted) {
    const std::vector<glm::dmat4> nearestFirst(sorted.placements.rbegin(), sorted.placements.rend());
    FrameInputs in = sorted;
    in.placements = nearestFirst;
    in.motion.offsets = {};
    RunPass(context, in, Pass::Base, [&] { skin_.Draw(context, binding_, model, in); });
  }

  void DrawAllFur(rhi::IContext& context, const GpuModel& model, const FrameInputs& in, bool fins) {
    for (size_t animal = 0; animal < in.placements.size(); ++animal)
      DrawFur(context, model, in, animal, fins, !fins);
  }

  void DrawFur(rhi::IContext& context, const GpuModel& model, const FrameInputs& in, size_t animal, bool fins,
               bool shells) {
    if (fins && settings_.drawFins) fins_.Draw(context, binding_, model, in, animal);
    if (shells && settings_.drawShells) shells_.Draw(context, binding_, model, in, animal);
  }

  RenderSettings settings_;
  PassBinding binding_;
  SkinPass skin_;
  FinPass fins_;
  ShellPass shells_;
  rhi::Ref<rhi::IBlendState> over_;
};

}  // namespace

rhi::Ref<rhi::IInputLayout> FurLayout(Creation& c, rhi::IShader* vs) {
  using rhi::Format;
  constexpr Format kFormat = Format::RGBA32_Float;
  constexpr rhi::InputElement kElements[] = {
      {.semantic = "POSITION", .format = kFormat, .offset = offsetof(FurVertex, position)},
      {.semantic = "NORMAL", .format = kFormat, .offset = offsetof(FurVertex, direction)},
      {.semantic = "TANGENT", .format = kFormat, .offset = offsetof(FurVertex, tangent)},
      {.semantic = "TEXCOORD", .format = kFormat, .offset = offsetof(FurVertex, normal)},
      {.semantic = "TEXCOORD", .semanticIndex = 1, .format = kFormat, .offset = offsetof(FurVertex, furUv)}};
  rhi::Ref<rhi::IInputLayout> layout;
  if (vs)
    c.Check(c.Device().CreateInputLayout(kElements, uint32_t(std::size(kElements)), vs, &layout), "the fur's layout");
  return layout;
}

Result<std::unique_ptr<ITechnique>> MakeShellsTechnique(rhi::IDevice& device, const RenderSettings& settings) {
  if (Result<Done> ok = CheckFinMode(device.GetCaps(), settings); !ok) return ok.error();
  if (Result<Done> ok = CheckShellMode(device.GetCaps(), settings); !ok) return ok.error();
  Creation creation(device);
  auto technique = std::make_unique<ShellsTechnique>(creation, settings);
  if (creation.Failed()) return creation.Failure();
  return std::unique_ptr<ITechnique>(std::move(technique));
}

}  // namespace fur
