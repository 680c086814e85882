#include "bench_run.h"

#include <algorithm>
#include <chrono>

#include "bench_reference.h"
#include "render_job.h"
#include "stats.h"

namespace app {
namespace {

using fur::Done;
using fur::Error;
using fur::ErrorCode;
using fur::Result;
using Clock = std::chrono::steady_clock;

constexpr uint32_t kFewestRounds = 5;
constexpr double kHeatScale = 4;  // FLIP of .25 is as bright as it gets

double SecondsSince(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

struct Contestant {
  BenchResult result;
  fur::RenderSettings settings;
  std::unique_ptr<fur::Renderer> renderer;
};

class SceneRun {
 public:
  SceneRun(const fur::BenchScene& scene, const BenchOptions& options, const BenchProgress& progress)
      : options_(options), progress_(progress), crop_(CropOf(scene, options)) {
    out_.scene = scene;
  }

  Result<BenchSceneResult> Run(const std::vector<fur::BenchConfig>& configs, const std::vector<BenchDevice>& devices) {
    if (Result<Done> ok = Load(); !ok) return ok.error();
    if (Result<Done> ok = MakeReferences(configs); !ok) return ok.error();
    for (const BenchDevice& device : devices)
      for (const fur::BenchConfig& config : configs)
        if (Result<Done> ok = Enter(config, device, &device == &devices[0]); !ok) return ok.error();
    if (Result<Done> ok = Race(); !ok) return ok.error();
    Conclude();
    out_.seconds = SecondsSince(start_);
    return std::move(out_);
  }

 private:
  Result<Done> Load() {
    SceneFlags flags;
    if (!out_.scene.file.empty()) flags.model = (std::filesystem::path(options_.assets) / out_.scene.file).string();
    flags.count = out_.scene.animals;
    Result<fur::Model> model = LoadModel(flags);
    if (!model) return model.error();
    model_ = std::move(*model);
    Result<SceneView> view = MakeView(flags, model_, double(options_.width) / options_.height);
    if (!view) return view.error();
    view->camera.eye = view->camera.target + (view->camera.eye - view->camera.target) * out_.scene.distance;
    for (uint32_t i = 0; i < out_.scene.angles; ++i) {
      views_.push_back(*view);
      views_.back().camera = fur::TurnCamera(view->camera, 360.0 * i / out_.scene.angles);
    }
    return Done{};
  }

  Result<fur::RenderSettings> SettingsOf(const fur::BenchConfig& config) const {
    fur::RenderSettings s = config.settings;
    SceneFlags flags;
    flags.size = options_.size;
    flags.semantics = ToString(s.semantics);
    if (Result<Done> set = SetScene(flags, &s); !set) return set.error();
    return s;
  }

  const BenchTruth* TruthFor(const fur::RenderSettings& s) const {
    for (const BenchTruth& t : truths_)
      if (t.IsFor(s)) return &t;
    return nullptr;
  }

  Result<Done> MakeReferences(const std::vector<fur::BenchConfig>& configs) {
    for (const fur::BenchConfig& config : configs) {
      const Result<fur::RenderSettings> s = SettingsOf(config);
      if (!s) return s.error();
      if (TruthFor(*s)) continue;
      const std::string what = out_.scene.name + " reference " + std::to_string(truths_.size() + 1);
      Result<BenchTruth> truth =
          BenchTruth::Make(model_, views_, *s, crop_, options_, [&](double share) { progress_(what, share); });
      if (!truth) return truth.error();
      out_.references.push_back(truth->Report());
      truths_.push_back(std::move(*truth));
    }
    return Done{};
  }

  // Uploads, warms up, counts, and measures the error. What the device cannot draw is left out, in words.
  Result<Done> Enter(const fur::BenchConfig& config, const BenchDevice& device, bool pictures) {
    progress_(out_.scene.name + " " + device.backend->name, double(contestants_.size() % 64) / 64);
    const Result<fur::RenderSettings> settings = SettingsOf(config);
    if (!settings) return settings.error();
    Result<std::unique_ptr<fur::Renderer>> renderer = fur::MakeRenderer(*device.device, model_, *settings);
    if (!renderer && renderer.error().code == ErrorCode::NoDevice) {
      out_.skipped.push_back(config.name + " on " + device.backend->name + ": " + renderer.error().message);
      return Done{};
    }
    if (!renderer) return renderer.error();
    Contestant c{
        {config, device.backend->name, device.device->GetCaps().driver.data()}, *settings, std::move(*renderer)};
    const Result<double> first = TimeFrame(*c.renderer, views_[0].camera, views_[0].placements);
    if (!first) return first.error();
    c.result.firstFrameMs = *first;
    const Result<BenchError> error =
        Measure(*c.renderer, *settings, pictures && options_.pictures ? &c.result.picture : nullptr);
    if (!error) return error.error();
    c.result.error = *error;
    if (config.settings.technique == fur::Technique::Seed)
      if (Result<Done> ok = TryWithoutFins(*device.device, &c); !ok) return ok;
    const Result<fur::FrameCounts> counts = c.renderer->Count(views_[0].camera, views_[0].placements);
    if (!counts) return counts.error();
    c.result.counts = *counts;
    contestants_.push_back(std::move(c));
    return Done{};
  }

  Result<BenchError> Measure(fur::Renderer& renderer, const fur::RenderSettings& settings,
                             BenchPicture* picture) const {
    const BenchTruth& truth = *TruthFor(settings);
    BenchError mean;
    const double n = double(views_.size());
    for (size_t i = 0; i < views_.size(); ++i) {
      renderer.Draw(views_[i].camera, views_[i].placements);
      if (Result<Done> done = renderer.Finish(); !done) return done.error();
      const Result<BenchFrame> frame = ReadFrame(renderer, settings, crop_);
      if (!frame) return frame.error();
      const Result<fur::Comparison> c = truth.Compare(i, *frame);
      if (!c) return c.error();
      mean.maskFlip += c->flip.maskMean.value_or(0) / n;
      mean.maskRmse += c->maskRmse.value_or(0) / n;
      mean.flip += c->flip.mean / n;
      mean.flipP99 += c->flip.p99 / n;
      mean.rmse += c->rmse / n;
      if (c->bandOpacityRmse) mean.bandRmse = mean.bandRmse.value_or(0) + *c->bandOpacityRmse / n;
      if (picture && i == 0)
        *picture =
            Thumbnail(ShownBytes(frame->picture), fur::HeatMap(c->flipMap, kHeatScale), crop_.width, crop_.height);
    }
    return mean;
  }

  // The published fins may do harm; the baseline is not to look worse for them.
  Result<Done> TryWithoutFins(rhi::IDevice& device, Contestant* c) const {
    fur::RenderSettings s = c->settings;
    s.drawFins = false;
    Result<std::unique_ptr<fur::Renderer>> bare = fur::MakeRenderer(device, model_, s);
    if (!bare) return bare.error();
    BenchPicture picture;
    const Result<BenchError> error = Measure(**bare, s, c->result.picture.frame.empty() ? nullptr : &picture);
    if (!error) return error.error();
    if (error->maskFlip >= c->result.error.maskFlip) return Done{};
    c->result.error = *error;
    c->result.errorWithoutFins = true;
    if (!picture.frame.empty()) c->result.picture = std::move(picture);
    return Done{};
  }

  // A frame of each in turn, every second round backwards, so that a drift within a round cancels too. The camera turns
  // from round to round: by half a degree, or to the next angle of a turntable.
  Result<Done> Race() {
    for (uint32_t round = 0; round < options_.warmUp + options_.rounds; ++round) {
      const bool timed = round >= options_.warmUp;
      if (timed && round >= options_.warmUp + kFewestRounds && SecondsSince(start_) > options_.secondsLeft) break;
      progress_(out_.scene.name + " rounds", double(round) / (options_.warmUp + options_.rounds));
      const SceneView& view = views_[round % views_.size()];
      const fur::Camera camera = views_.size() > 1 ? view.camera : fur::TurnCamera(view.camera, kTurnDegrees * round);
      for (size_t i = 0; i < contestants_.size(); ++i) {
        Contestant& c = contestants_[round % 2 ? contestants_.size() - 1 - i : i];
        const Result<double> ms = TimeFrame(*c.renderer, camera, view.placements);
        if (!ms) return ms.error();
        if (timed) c.result.frameMs.push_back(*ms);
      }
    }
    return Done{};
  }

  void Conclude() {
    for (Contestant& c : contestants_) {
      c.result.ms = fur::Summarise(c.result.frameMs);
      const auto baseline = std::find_if(contestants_.begin(), contestants_.end(), [&](const Contestant& other) {
        return other.result.backend == c.result.backend && other.settings.technique == fur::Technique::Seed;
      });
      if (baseline != contestants_.end()) c.result.ratio = fur::PairedRatio(c.result.frameMs, baseline->result.frameMs);
    }
    for (Contestant& c : contestants_) c.result.onFront = IsOnFront(c);
    for (Contestant& c : contestants_) out_.results.push_back(std::move(c.result));
  }

  // Only pictures of the same thing can be weighed against each other.
  bool IsOnFront(const Contestant& c) const {
    std::vector<fur::BenchPoint> points{{c.result.ms.median, c.result.error.maskFlip}};
    for (const Contestant& other : contestants_)
      if (other.result.backend == c.result.backend && TruthFor(other.settings) == TruthFor(c.settings))
        points.push_back({other.result.ms.median, other.result.error.maskFlip});
    return fur::ParetoFront(points)[0];
  }

  const Clock::time_point start_ = Clock::now();
  const BenchOptions& options_;
  const BenchProgress& progress_;
  BenchCrop crop_;
  BenchSceneResult out_;
  fur::Model model_;
  std::vector<SceneView> views_;
  std::vector<BenchTruth> truths_;
  std::vector<Contestant> contestants_;
};

}  // namespace

Result<BenchSceneResult> RunBenchScene(const fur::BenchScene& scene, const std::vector<fur::BenchConfig>& configs,
                                       const std::vector<BenchDevice>& devices, const BenchOptions& options,
                                       const BenchProgress& progress) {
  return SceneRun(scene, options, progress).Run(configs, devices);
}

}  // namespace app
