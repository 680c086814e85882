// fur reference: the picture that all techniques approximate, by the CPU in double precision.
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>

#include "commands.h"
#include "fur/file.h"
#include "fur/image_io.h"
#include "fur/reference.h"
#include "scene_flags.h"

namespace app {
namespace {

using fur::Done;
using fur::Error;
using fur::ErrorCode;
using fur::Result;

constexpr uint32_t kMaxSamples = 65536;
constexpr uint32_t kMaxThreads = 1024;

struct ReferenceFlags {
  SceneFlags scene;
  std::string output = "reference.png", crop, cache;
  uint32_t samples = 64, threads = 0;
  uint64_t seed = 0;
  double tolerance = 5e-3;
  bool noCache = false;
};

Result<Done> SetCrop(const std::string& text, fur::ReferenceSettings* s) {
  if (text.empty()) return Done{};
  char rest = 0;
  const int read = std::sscanf(text.c_str(), "%u,%u,%u,%u%c", &s->cropX, &s->cropY, &s->cropWidth, &s->cropHeight, &rest);
  const bool fits = s->cropX < s->width && s->cropY < s->height && s->cropWidth <= s->width - s->cropX &&
                    s->cropHeight <= s->height - s->cropY && s->cropWidth > 0 && s->cropHeight > 0;
  if (read == 4 && fits && text.find('-') == std::string::npos) return Done{};
  return Error{ErrorCode::Usage, fmt::format("--crop takes x,y,width,height within {}x{}, not '{}'", s->width, s->height, text)};
}

Result<fur::ReferenceSettings> MakeSettings(const ReferenceFlags& f) {
  fur::RenderSettings render;
  render.look = f.scene.look == "seed" ? fur::Look::Seed : fur::Look::Correct;
  if (Result<Done> scene = SetScene(f.scene, render.look == fur::Look::Seed, &render); !scene) return scene.error();
  fur::ReferenceSettings s;
  s.width = render.width;
  s.height = render.height;
  s.look = render.look;
  s.semantics = render.semantics;
  s.background = render.background;
  s.light = render.light;
  s.comb = render.comb;
  s.bend = render.bend;
  s.samplesPerPixel = f.samples;
  s.threads = f.threads;
  s.seed = f.seed;
  s.tolerance = f.tolerance;
  if (Result<Done> crop = SetCrop(f.crop, &s); !crop) return crop.error();
  return s;
}

// Empty: no cache.
std::string CacheFolder(const ReferenceFlags& f) {
  if (f.noCache || !f.cache.empty()) return f.noCache ? std::string() : f.cache;
  const char* const base = std::getenv("XDG_CACHE_HOME");
  if (base && *base) return std::string(base) + "/fur";
  const char* const home = std::getenv("HOME");
  return home && *home ? std::string(home) + "/.cache/fur" : std::string();
}

// One line that is written over, on a terminal.
class ProgressBar {
 public:
  ProgressBar() : shown_(isatty(STDERR_FILENO) != 0) {}
  ~ProgressBar() {
    if (shown_) fmt::print(stderr, "\r{:60}\r", "");
  }
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;
  void Show(double done) {
    const int percent = int(done * 100);
    if (!shown_ || percent == last_) return;
    last_ = percent;
    constexpr int kWidth = 40;
    fmt::print(stderr, "\r[{:<{}}] {:3} %", std::string(size_t(done * kWidth), '#'), kWidth, percent);
    std::fflush(stderr);
  }

 private:
  bool shown_;
  int last_ = -1;
};

uint8_t ToByte(double linear, fur::Look look) {
  const double v = std::clamp(linear, 0.0, 1.0);
  // IEC 61966-2-1; look seed is stored as it is.
  const double encoded = look == fur::Look::Seed ? v : v <= 0.0031308 ? v * 12.92 : 1.055 * std::pow(v, 1 / 2.4) - 0.055;
  return uint8_t(std::lround(encoded * 255));
}

Result<Done> WritePicture(const std::string& file, const fur::FloatImage& image, fur::Look look) {
  const std::string kind = std::filesystem::path(file).extension().string();
  if (kind == ".raw") {
    const auto* bytes = reinterpret_cast<const uint8_t*>(image.pixels.data());
    return fur::WriteFile(file, std::span(bytes, image.pixels.size() * sizeof(glm::vec4)));
  }
  std::vector<uint8_t> rgba;
  rgba.reserve(image.pixels.size() * 4);
  for (const glm::vec4& p : image.pixels) {
    for (int c = 0; c < 3; ++c) rgba.push_back(ToByte(double(p[c]), look));
    rgba.push_back(255);
  }
  return fur::WritePng(file, image.width, image.height, rgba);
}

Result<Done> CheckOutput(const std::string& file) {
  const std::string kind = std::filesystem::path(file).extension().string();
  if (kind != ".png" && kind != ".raw")
    return Error{ErrorCode::Usage, "-o takes a .png or a .raw (rows of four 32-bit floats a pixel), not '" + file + "'"};
  return fur::CheckWritable(file);
}

struct Outcome {
  fur::ReferenceImage image;
  bool cached = false;
  double seconds = 0;
};

Result<Outcome> Obtain(const ReferenceFlags& f, const fur::Model& model, const SceneView& view,
                       fur::ReferenceSettings settings) {
  const std::string folder = CacheFolder(f);
  const std::string key = fur::ReferenceKey(model, view.camera, view.placements, settings);
  if (!folder.empty())
    if (Result<fur::ReferenceImage> kept = fur::LoadReference(folder, key)) return Outcome{std::move(*kept), true, 0};
  const auto start = std::chrono::steady_clock::now();
  ProgressBar bar;
  settings.progress = [&](double done) { bar.Show(done); };
  Result<fur::ReferenceImage> made = fur::RenderReference(model, view.camera, view.placements, settings);
  if (!made) return made.error();
  Outcome outcome{std::move(*made), false, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count()};
  if (folder.empty()) return outcome;
  // A cache that cannot be written costs time only.
  if (Result<Done> stored = fur::StoreReference(folder, key, outcome.image); !stored)
    PrintMessages({"the picture is not kept: " + stored.error().message});
  return outcome;
}

Result<Done> CheckFinite(const fur::FloatImage& image) {
  for (const glm::vec4& p : image.pixels)
    if (!std::isfinite(p.r + p.g + p.b + p.a))
      return Error{ErrorCode::RenderFailed, "the reference has a pixel that is no number; please report it"};
  return Done{};
}

Result<Done> Run(const ReferenceFlags& f) {
  if (Result<Done> ok = CheckOutput(f.output); !ok) return ok.error();
  const Result<fur::ReferenceSettings> settings = MakeSettings(f);
  if (!settings) return settings.error();
  Result<fur::Model> model = LoadModel(f.scene);
  if (!model) return model.error();
  PrintMessages(model->warnings);
  Result<SceneView> view = MakeView(f.scene, *model, double(settings->width) / settings->height);
  if (!view) return view.error();
  Result<Outcome> outcome = Obtain(f, *model, *view, *settings);
  if (!outcome) return outcome.error();
  const fur::FloatImage& color = outcome->image.color;
  if (Result<Done> finite = CheckFinite(color); !finite) return finite.error();
  if (Result<Done> written = WritePicture(f.output, color, settings->look); !written) return written.error();
  fmt::print("reference: {} ({}x{}, {} samples a pixel, {})\n", f.output, color.width, color.height, f.samples,
             outcome->cached ? std::string("from the cache") : fmt::format("{:.1f} s", outcome->seconds));
  return Done{};
}

void AddFlags(CLI::App* c, ReferenceFlags* f) {
  AddSceneFlags(c, &f->scene);
  c->add_option("-o,--output", f->output, "PNG, or .raw: rows of four 32-bit floats a pixel, linear for look correct")
      ->capture_default_str();
  c->add_option("--spp", f->samples, "Stratified samples a pixel, rounded up to a full grid")
      ->check(CLI::Range(1u, kMaxSamples))->capture_default_str();
  c->add_option("--seed", f->seed, "Of the samples' jitter: two seeds give two independent pictures")->capture_default_str();
  c->add_option("--threads", f->threads, "Threads; 0: one for each core. The picture does not depend on it")
      ->check(CLI::Range(0u, kMaxThreads))->capture_default_str();
  c->add_option("--tolerance", f->tolerance, "Error allowed to a step of the integration")
      ->check(kFinite)->check(CLI::Range(1e-12, 1.0))->capture_default_str();
  c->add_option("--crop", f->crop, "Renders x,y,width,height of the picture only");
  c->add_option("--cache", f->cache, "Folder of finished pictures; default $XDG_CACHE_HOME/fur or ~/.cache/fur");
  c->add_flag("--no-cache", f->noCache, "Neither look for a finished picture nor keep this one");
}

}  // namespace

void AddReferenceCommand(CLI::App& app, Command* run) {
  auto flags = std::make_shared<ReferenceFlags>();
  CLI::App* c = app.add_subcommand("reference", "Integrate the fur model on the CPU: the picture that render approximates");
  AddFlags(c, flags.get());
  c->callback([flags, run] {
    *run = [flags] {
      Result<Done> done = Run(*flags);
      return done ? 0 : Fail(done.error());
    };
  });
}

}  // namespace app
