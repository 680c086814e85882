// fur render: a model, a camera and a technique become a picture on one backend, or on each with their difference.
#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <optional>
#include <set>

#include "commands.h"
#include "flag_checks.h"
#include "fur/bench.h"
#include "fur/file.h"
#include "fur/image_io.h"
#include "picture_file.h"
#include "preset_flags.h"
#include "render_job.h"
#include "scene_flags.h"
#include "stats.h"

namespace app {
namespace {

using fur::Done;
using fur::Error;
using fur::ErrorCode;
using fur::Result;

constexpr uint32_t kMaxShells = 512;

struct RenderFlags {
  SceneFlags scene;
  std::string output = "fur.png", backend = "vulkan", technique = "shells", preset, stats, shellMode = "sorted",
              finMode = "auto", adapter;
  uint32_t samples = 1, skinSamples = 0, shells = 0, shellsAtOnce = 1, repeat = 1, supersample = 1;
  double finThreshold = 0.25, deadZone = 0.25, spacing = 0;
  std::optional<double> finOpacity;
  bool floatTextures = false, noFins = false, noShells = false, noBackFaces = false, noSort = false, validate = false;
  std::set<std::string> given;  // the flags on the command line
};

// What belongs to technique shells alone, or to a preset too.
void SetShellOptions(const RenderFlags& f, fur::RenderSettings* s) {
  s->shellMode = Choose<fur::ShellMode>(f.shellMode, {{"sorted", fur::ShellMode::Sorted},
                                                      {"instanced", fur::ShellMode::Instanced},
                                                      {"draws", fur::ShellMode::Draws},
                                                      {"amplified", fur::ShellMode::Amplified}});
  s->shellsAtOnce = f.shellsAtOnce;
  s->finMode = Choose<fur::FinMode>(f.finMode, {{"auto", fur::FinMode::Auto},
                                                {"geometry", fur::FinMode::Geometry},
                                                {"pulled", fur::FinMode::Pulled},
                                                {"compacted", fur::FinMode::Compacted}});
  s->finThreshold = f.finThreshold;
  s->finOpacity = f.finOpacity;
  s->backFaces = !f.noBackFaces;
  s->sortAnimals = !f.noSort;
  s->finDeadZone = f.deadZone;
  s->spacing = f.spacing;
}

Result<fur::RenderSettings> MakeSettings(const RenderFlags& f) {
  fur::RenderSettings s;
  s.samples = f.samples;
  s.skinSamples = f.skinSamples;
  s.look = LookOf(f.scene);
  s.technique = f.technique == "seed" ? fur::Technique::Seed : fur::Technique::Shells;
  if (Result<Done> preset = SetPreset(f.preset, f.scene.coat, f.given, &s); !preset) return preset.error();
  if (Result<Done> scene = SetScene(f.scene, &s); !scene) return scene.error();
  s.shells = f.shells;
  s.floatTextures = f.floatTextures;
  s.drawFins = !f.noFins;
  s.drawShells = !f.noShells;
  SetShellOptions(f, &s);
  if (f.supersample > 1 && s.technique == fur::Technique::Seed)
    return Error{ErrorCode::Usage, "--supersample needs a frame of floats, which technique seed and its presets have not"};
  if (f.supersample > 1) s.target = fur::TargetFormat::Float32;  // the mean is nearer than half floats' cutting
  s.width *= f.supersample;
  s.height *= f.supersample;
  if (std::max(s.width, s.height) > kMaxSide)
    return Error{ErrorCode::Usage, fmt::format("--size times --supersample must not exceed {} a side", kMaxSide)};
  return s;
}

// out.png -> out.vulkan.png
std::filesystem::path WithBackend(const std::filesystem::path& file, const std::string& backend) {
  std::filesystem::path named = file;
  return named.replace_extension(backend + file.extension().string());
}

std::filesystem::path PictureFile(const RenderFlags& f, const std::string& backend) {
  return f.backend == "both" ? WithBackend(f.output, backend) : std::filesystem::path(f.output);
}

std::vector<std::filesystem::path> OutputFiles(const RenderFlags& f) {
  std::vector<std::filesystem::path> files;
  for (const BackendEntry* b : SelectBackends(f.backend)) files.push_back(PictureFile(f, b->name));
  if (!f.stats.empty()) files.push_back(f.stats);
  return files;
}

std::string Throughput(const RenderOutcome& out) {
  return fmt::format("{:.1f} ms a frame (median of {}; the first took {:.0f} ms), {} draws, {} fragments", fur::Median(out.frameMs),
                     out.frameMs.size(), out.firstFrameMs, out.counts.draws,
                     out.counts.baseFragments + out.counts.finFragments + out.counts.shellFragments);
}

nlohmann::ordered_json AllStats(const std::vector<RenderOutcome>& outcomes, const RenderJob& job) {
  if (outcomes.size() == 1) return StatsJson(outcomes[0], job);
  nlohmann::ordered_json j;
  for (const RenderOutcome& out : outcomes) j["runs"].push_back(StatsJson(out, job));
  j["difference"] = DifferenceJson(CompareImages(outcomes[0].image, outcomes[1].image));
  return j;
}

Result<Done> WriteOutputs(const RenderFlags& f, const RenderJob& job, const std::vector<RenderOutcome>& outcomes) {
  for (const RenderOutcome& out : outcomes) {
    const std::filesystem::path file = PictureFile(f, out.backend);
    Result<Done> written = WritePicture(file, out, job.settings);
    if (!written) return written.error();
    fmt::print("{}: {} ({})\n  {}\n", out.backend, file.string(), out.caps.driver.data(), Throughput(out));
  }
  if (f.stats.empty()) return Done{};
  return fur::WriteFile(f.stats, AllStats(outcomes, job).dump(2) + "\n");
}

void PrintDifference(const RenderOutcome& a, const RenderOutcome& b) {
  const ImageDifference d = CompareImages(a.image, b.image);
  fmt::print("difference {} - {}: {:.4f} % of pixels bit-equal ({} of {} differ), largest {}/255, mean {:.6f}/255\n", a.backend,
             b.backend, 100 * d.EqualShare(), d.differing, d.pixels, d.largest, d.mean);
}

Result<RenderJob> PrepareJob(const RenderFlags& f, const fur::Model& model) {
  RenderJob job;
  Result<fur::RenderSettings> settings = MakeSettings(f);
  if (!settings) return settings.error();
  job.settings = *settings;
  job.supersample = f.supersample;
  Result<SceneView> view = MakeView(f.scene, model, double(settings->width) / settings->height);
  if (!view) return view.error();
  job.placements = std::move(view->placements);
  job.camera = view->camera;
  job.repeat = f.repeat;
  job.validate = f.validate;
  job.adapter = f.adapter;
  job.floatFrame = IsExrName(f.output);
  return job;
}

Result<Done> Render(const RenderFlags& f) {
  if (!f.stats.empty() && f.stats == f.output)
    return Error{ErrorCode::Usage, "-o and --stats name the same file: " + f.output};
  for (const std::filesystem::path& file : OutputFiles(f))
    if (Result<Done> ok = fur::CheckWritable(file); !ok) return ok.error();
  Result<fur::RenderSettings> settings = MakeSettings(f);
  if (!settings) return settings.error();
  if (Result<Done> ok = CheckPictureFile(f.output, *settings); !ok) return ok.error();
  SceneFlags scene = f.scene;
  if (!f.preset.empty()) scene.coat.clear();  // one of the preset's own
  Result<fur::Model> model = LoadModel(scene);
  if (!model) return model.error();
  PrintMessages(model->warnings);
  Result<RenderJob> job = PrepareJob(f, *model);
  if (!job) return job.error();

  std::vector<RenderOutcome> outcomes;  // all are rendered before the first file is written
  for (const BackendEntry* backend : SelectBackends(f.backend)) {
    Result<RenderOutcome> out = RunRenderJob(*backend, *model, *job);
    if (!out) return out.error();
    PrintMessages(out->messages);
    outcomes.push_back(std::move(*out));
  }
  if (Result<Done> written = WriteOutputs(f, *job, outcomes); !written) return written.error();
  if (outcomes.size() > 1) PrintDifference(outcomes[0], outcomes[1]);
  return Done{};
}

void AddPresetFlags(CLI::App* c, RenderFlags* f) {
  c->add_option("--preset", f->preset, "A published system's shells and fins, and its look (docs/presets.md); technique seed, look seed")
      ->check(CLI::IsMember({"demo-fur", "nvidia-d3d10", "gs-shells", "four-coats"}));
  c->add_option("--dead-zone", f->deadZone, "Presets gs-shells, four-coats: an edge whose mean normal is this near to perpendicular to the view grows a fin, 0..1")
      ->check(kFinite)->check(CLI::Range(0.0, 1.0))->capture_default_str();
}

void AddShellFlags(CLI::App* c, RenderFlags* f) {
  c->add_option("--shell-mode", f->shellMode, "Shells sorted, triangle by triangle from back to front; or shell by shell: by instances, by a draw each, or amplified by a geometry shader")
      ->check(CLI::IsMember({"sorted", "instanced", "draws", "amplified"}))->capture_default_str();
  c->add_option("--shells-at-once", f->shellsAtOnce,
                "Amplified: shells of a triangle in one go, 1..14; above 1 overlapping limbs look different")
      ->check(CLI::Range(1u, 14u))->capture_default_str();
  c->add_option("--fins", f->finMode, "Fins by a geometry shader, pulled by the vertex shader, or compacted first; auto: the best there is")
      ->check(CLI::IsMember({"auto", "geometry", "pulled", "compacted"}))->capture_default_str();
  c->add_option("--fin-threshold", f->finThreshold, "Edges this near to the silhouette grow a fading fin, 0..1")
      ->check(kFinite)->check(CLI::Range(0.0, 1.0))->capture_default_str();
  c->add_option("--fin-opacity", f->finOpacity, "Opacity of a fin on the silhouette, 0..1 (.9; in a volume 1, of its fur's)")->check(kFinite)->check(CLI::Range(0.0, 1.0));
  c->add_option("--spacing", f->spacing, "Distance of two shells in the model's units; the length is N times it")->check(kFinite)->check(CLI::PositiveNumber);
  c->add_flag("--no-back-faces", f->noBackFaces, "Leave out the fur that is seen from behind");
  c->add_flag("--no-sort", f->noSort, "Draw the animals in the order given instead of back to front");
}

void AddFlags(CLI::App* c, RenderFlags* f) {
  AddSceneFlags(c, &f->scene);
  CLI::Option* coat = c->get_option("--coat");
  coat->description(coat->get_description() +
                    ". With --preset four-coats whose colours it wears: bear, panther, snow, tiger; default bear");
  c->add_option("-o,--output", f->output, "PNG to write, or EXR: the frame in linear floats, alpha its opacity; with --backend both, FILE.vulkan.png and FILE.gl.png")->capture_default_str();
  c->add_option("--backend", f->backend, "vulkan, gl, or both (renders with each and prints the difference)")
      ->check(CLI::IsMember({"vulkan", "gl", "both"}))->capture_default_str();
  c->add_option("--adapter", f->adapter, "Part of an adapter's name (fur info lists them); default: the first");
  c->add_option("--samples", f->samples, "Samples a pixel, 1 or 4")->check(CLI::IsMember({1, 4}))->capture_default_str();
  c->add_option("--skin-samples", f->skinSamples, "Samples a pixel of whiskers, eyes and other parts without fur, 1 or 4; default: as --samples; technique shells")
      ->check(CLI::IsMember({1, 4}));
  c->add_option("--supersample", f->supersample, "Frames N times as wide and high, averaged in linear light; technique shells")
      ->check(CLI::Range(1u, 8u))->capture_default_str();
  c->add_option("--technique", f->technique, "shells, or seed: shells and fins as published")->check(CLI::IsMember({"shells", "seed"}))->capture_default_str();
  c->add_option("--shells", f->shells, "Number of shells, 1..512; default: as the coat says")->check(CLI::Range(1u, kMaxShells));
  c->add_option("--repeat", f->repeat, "Timed frames after the first")->check(CLI::Range(0u, 100000u))->capture_default_str();
  c->add_option("--stats", f->stats, "JSON file for times and counts");
  c->add_flag("--float-textures", f->floatTextures,
              "Textures as 32-bit floats: exact decoding and filter weights, for measurements; slow");
  c->add_flag("--no-fins", f->noFins, "Draw no fins");
  c->add_flag("--no-shells", f->noShells, "Draw no shells");
  AddPresetFlags(c, f);
  AddShellFlags(c, f);
  c->add_flag("--validate", f->validate, "Run with the drivers' validation; messages go to stderr and into the stats");
}

}  // namespace

void AddRenderCommand(CLI::App& app, Command* run) {
  auto flags = std::make_shared<RenderFlags>();
  CLI::App* c = app.add_subcommand("render", "Render a model, or the built-in animal, to a PNG or an EXR");
  AddFlags(c, flags.get());
  c->callback([c, flags, run] {
    for (const CLI::Option* option : c->get_options())
      if (option->count() > 0) flags->given.insert(option->get_name());
    *run = Running(flags, Render);
  });
}

}  // namespace app
