// fur reference: the picture that all techniques approximate, by the CPU in double precision.
#include <fmt/format.h>

#include <cmath>
#include <set>

#include "commands.h"
#include "flag_checks.h"
#include "fur/exr_io.h"
#include "fur/file.h"
#include "fur/image_io.h"
#include "picture_file.h"
#include "progress_bar.h"
#include "reference_cache.h"

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
  std::string output = "reference.png", mask, band, crop, cache;
  uint32_t samples = 64, threads = 0;
  uint64_t seed = 0;
  double tolerance = 5e-3;
  bool noCache = false, progress = false;
};

Result<Done> SetCrop(const std::string& text, fur::ReferenceSettings* s) {
  if (text.empty()) return Done{};
  char rest = 0;
  const int read =
      std::sscanf(text.c_str(), "%u,%u,%u,%u%c", &s->cropX, &s->cropY, &s->cropWidth, &s->cropHeight, &rest);
  const bool fits = s->cropX < s->width && s->cropY < s->height && s->cropWidth <= s->width - s->cropX &&
                    s->cropHeight <= s->height - s->cropY && s->cropWidth > 0 && s->cropHeight > 0;
  if (read == 4 && fits && text.find('-') == std::string::npos) return Done{};
  return Error{ErrorCode::Usage,
               fmt::format("--crop takes x,y,width,height within {}x{}, not '{}'", s->width, s->height, text)};
}

Result<fur::ReferenceSettings> MakeSettings(const ReferenceFlags& f) {
  fur::RenderSettings render;
  render.look = LookOf(f.scene);
  if (Result<Done> scene = SetScene(f.scene, &render); !scene) return scene.error();
  fur::ReferenceSettings s = ReferenceOf(render);
  s.samplesPerPixel = f.samples;
  s.threads = f.threads;
  s.seed = f.seed;
  s.tolerance = f.tolerance;
  if (Result<Done> crop = SetCrop(f.crop, &s); !crop) return crop.error();
  return s;
}

Result<Done> CheckOutputs(const ReferenceFlags& f) {
  std::set<std::string> names;
  for (const auto& [flag, file] : {std::pair{"-o", &f.output}, {"--mask", &f.mask}, {"--band", &f.band}}) {
    if (file->empty()) continue;
    if (!names.insert(*file).second) return Error{ErrorCode::Usage, fmt::format("{} is written twice", *file)};
    if (!IsExrName(*file) && std::filesystem::path(*file).extension() != ".png")
      return Error{ErrorCode::Usage, fmt::format("{} takes a .png or an .exr, not '{}'", flag, *file)};
    if (Result<Done> ok = fur::CheckWritable(*file); !ok) return ok;
  }
  return Done{};
}

// Values of 0..1 as grey and as alpha. In bytes they are rounded up: what is above 1/255 stays above it.
Result<Done> WriteRegion(const std::string& file, const fur::Plane& plane) {
  if (file.empty()) return Done{};
  fur::FloatImage image{plane.width, plane.height, {}};
  for (const float v : plane.values) image.pixels.emplace_back(IsExrName(file) ? v : std::ceil(v * 255) / 255);
  if (IsExrName(file)) return fur::WriteExr(file, image);
  return fur::WritePng(file, image.width, image.height, fur::ToBytes(image));
}

Result<Done> CheckFinite(const fur::FloatImage& image) {
  for (const glm::vec4& p : image.pixels)
    if (!std::isfinite(p.r + p.g + p.b + p.a))
      return Error{ErrorCode::RenderFailed, "the reference has a pixel that is no number; please report it"};
  return Done{};
}

Result<Done> WriteOutputs(const ReferenceFlags& f, const fur::ReferenceImage& image, fur::Look look) {
  if (Result<Done> finite = CheckFinite(image.color); !finite) return finite;
  if (Result<Done> written = WriteFrame(f.output, image.color, look); !written) return written;
  if (Result<Done> written = WriteRegion(f.mask, fur::MaskOf(image)); !written) return written;
  return WriteRegion(f.band, fur::BandOf(image));
}

Result<CachedReference> Obtain(const ReferenceFlags& f, const fur::Model& model, const SceneView& view,
                               fur::ReferenceSettings settings) {
  ProgressBar bar(f.progress);
  settings.progress = [&](double done) { bar.Show("reference", done); };
  return ObtainReference(f.noCache         ? std::string()
                         : f.cache.empty() ? DefaultCacheFolder()
                                           : f.cache,
                         model, view, settings);
}

Result<Done> Run(const ReferenceFlags& f) {
  if (Result<Done> ok = CheckOutputs(f); !ok) return ok;
  const Result<fur::ReferenceSettings> settings = MakeSettings(f);
  if (!settings) return settings.error();
  Result<fur::Model> model = LoadModel(f.scene);
  if (!model) return model.error();
  PrintMessages(model->warnings);
  Result<SceneView> view = MakeView(f.scene, *model, double(settings->width) / settings->height);
  if (!view) return view.error();
  Result<CachedReference> reference = Obtain(f, *model, *view, *settings);
  if (!reference) return reference.error();
  if (Result<Done> written = WriteOutputs(f, reference->image, settings->look); !written) return written;
  const fur::FloatImage& color = reference->image.color;
  fmt::print("reference: {} ({}x{}, {} samples a pixel, {})\n", f.output, color.width, color.height, f.samples,
             reference->cached ? std::string("from the cache") : fmt::format("{:.1f} s", reference->seconds));
  return Done{};
}

void AddFlags(CLI::App* c, ReferenceFlags* f) {
  AddSceneFlags(c, &f->scene);
  c->add_option("-o,--output", f->output, "PNG, or EXR: linear floats over the background, alpha the opacity")
      ->capture_default_str();
  c->add_option("--mask", f->mask, "PNG or EXR of the fur's opacity, for fur compare --mask");
  c->add_option("--band", f->band,
                "PNG or EXR of the fur's opacity where no skin lies behind it, for fur compare --band");
  c->add_option("--spp", f->samples, "Samples a pixel, spread evenly; powers of two are best")
      ->check(CLI::Range(1u, kMaxSamples))
      ->capture_default_str();
  c->add_option("--seed", f->seed, "Of the samples: two seeds give two independent pictures")
      ->capture_default_str();
  c->add_option("--threads", f->threads, "Threads; 0: one for each core. The picture does not depend on it")
      ->check(CLI::Range(0u, kMaxThreads))
      ->capture_default_str();
  c->add_option("--tolerance", f->tolerance, "Error allowed to a step of the integration")
      ->check(kFinite)
      ->check(CLI::Range(1e-12, 1.0))
      ->capture_default_str();
  c->add_option("--crop", f->crop, "Renders x,y,width,height of the picture only");
  c->add_option("--cache", f->cache, "Folder of finished pictures; default $XDG_CACHE_HOME/fur or ~/.cache/fur");
  c->add_flag("--no-cache", f->noCache, "Neither look for a finished picture nor keep this one");
  c->add_flag("--progress", f->progress, "Show the progress bar even where stderr is no terminal");
}

}  // namespace

void AddReferenceCommand(CLI::App& app, Command* run) {
  auto flags = std::make_shared<ReferenceFlags>();
  CLI::App* c = app.add_subcommand("reference", "Integrate the fur on the CPU: the picture that render approximates");
  AddFlags(c, flags.get());
  c->callback([flags, run] { *run = Running(flags, Run); });
}

}  // namespace app
