// fur bench: run time against error over techniques, options, scenes and backends.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <memory>
#include <optional>
#include <sstream>

#include "bench_report.h"
#include "commands.h"
#include "fur/file.h"
#include "progress_bar.h"

namespace app {
namespace {

using fur::Done;
using fur::Error;
using fur::ErrorCode;
using fur::Result;

constexpr double kQuickSeconds = 140;  // of the 180 that it promises: what is begun is finished
constexpr double kSlower = 1.2;

struct BenchFlags {
  std::string assets = "../shared/assets", scenes, configs, techniques, backend = "both", adapter, size, json, html,
              agree, cache;
  std::optional<uint32_t> rounds, samples;
  bool quick = false, list = false, noCache = false, progress = false;
};

std::vector<fur::BenchScene> ChosenScenes(const BenchFlags& f) {
  std::vector<fur::BenchScene> scenes = fur::BenchScenes();
  std::erase_if(scenes, [&](const fur::BenchScene& s) {
    return !fur::MatchesAny(s.name, f.scenes) || (f.quick && f.scenes.empty() && !s.quick);
  });
  return scenes;
}

// The baseline is in every run.
std::vector<fur::BenchConfig> ChosenConfigs(const BenchFlags& f) {
  std::vector<fur::BenchConfig> configs = fur::BenchConfigs();
  const std::string baseline = configs[0].name;
  std::erase_if(configs, [&](const fur::BenchConfig& c) {
    const bool technique =
        fur::MatchesAny(c.settings.technique == fur::Technique::Seed ? "seed" : "shells", f.techniques);
    const bool named = fur::MatchesAny(c.name, f.configs) && (!f.quick || !f.configs.empty() || c.quick);
    return c.name != baseline && !(technique && named);
  });
  return configs;
}

// A filter that nothing matches is a misspelling.
template <class T>
Result<Done> CheckFilter(const char* flag, const std::string& patterns, const std::vector<T>& all) {
  std::istringstream in(patterns);
  for (std::string pattern; std::getline(in, pattern, ',');) {
    const bool matches =
        std::any_of(all.begin(), all.end(), [&](const T& one) { return fur::MatchesAny(one.name, pattern); });
    if (!matches || pattern.empty())
      return Error{ErrorCode::Usage, fmt::format("{} names '{}', which is none of fur bench --list", flag, pattern)};
  }
  return Done{};
}

Result<BenchOptions> MakeOptions(const BenchFlags& f) {
  BenchOptions o;
  o.assets = f.assets;
  o.cache = f.noCache ? std::string() : f.cache.empty() ? DefaultCacheFolder() : f.cache;
  o.rounds = f.rounds.value_or(f.quick ? 9 : 15);
  o.samples = f.samples.value_or(f.quick ? 16 : 64);
  if (!f.size.empty() || f.quick) o.size = f.size.empty() ? "320x180" : f.size;
  o.pictures = !f.html.empty();
  SceneFlags flags;
  flags.size = o.size;
  fur::RenderSettings settings;
  if (Result<Done> ok = SetScene(flags, &settings); !ok) return ok.error();
  o.width = settings.width;
  o.height = settings.height;
  return o;
}

Result<Done> CheckFlags(const BenchFlags& f) {
  if (Result<Done> ok = CheckFilter("--scenes", f.scenes, fur::BenchScenes()); !ok) return ok;
  if (Result<Done> ok = CheckFilter("--configs", f.configs, fur::BenchConfigs()); !ok) return ok;
  if (!f.json.empty() && f.json == f.html)
    return Error{ErrorCode::Usage, "--json and --html name the same file: " + f.json};
  for (const std::string& file : {f.json, f.html})
    if (!file.empty())
      if (Result<Done> ok = fur::CheckWritable(file); !ok) return ok;
  return Done{};
}

void PrintList(const BenchFlags& f) {
  fmt::print("scenes:\n");
  for (const fur::BenchScene& s : ChosenScenes(f))
    fmt::print("  {:<24} {}\n", s.name, s.file.empty() ? "built-in animal" : s.file);
  fmt::print("configurations:\n");
  for (const fur::BenchConfig& c : ChosenConfigs(f)) fmt::print("  {:<24} {}\n", c.name, c.note);
}

// Kept alive together: the devices report to the collector.
struct Devices {
  MessageCollector messages;
  std::vector<BenchDevice> all;
};

Result<Done> OpenDevices(const BenchFlags& f, Devices* devices) {
  for (const BackendEntry* backend : SelectBackends(f.backend)) {
    Result<rhi::Ref<rhi::IDevice>> device = MakeDevice(*backend, f.adapter, false, &devices->messages);
    if (!device) return device.error();
    devices->all.push_back({backend, std::move(*device)});
  }
  return Done{};
}

// The chosen scenes whose models are there.
std::vector<fur::BenchScene> PresentScenes(const BenchFlags& f, BenchReport* report) {
  std::vector<fur::BenchScene> scenes = ChosenScenes(f);
  std::erase_if(scenes, [&](const fur::BenchScene& scene) {
    const std::filesystem::path file = std::filesystem::path(f.assets) / scene.file;
    std::error_code unknown;
    if (scene.file.empty() || std::filesystem::exists(file, unknown)) return false;
    report->skipped.push_back(fmt::format("{}: {} is not there (--assets)", scene.name, file.string()));
    return true;
  });
  return scenes;
}

double Seconds(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

Result<Done> RunScenes(const BenchFlags& f, const std::vector<BenchDevice>& devices, BenchReport* report) {
  const auto start = std::chrono::steady_clock::now();
  const std::vector<fur::BenchConfig> configs = ChosenConfigs(f);
  const std::vector<fur::BenchScene> scenes = PresentScenes(f, report);
  double longest = 0;
  for (size_t i = 0; i < scenes.size(); ++i) {
    // Each gets its share of the time that is left, and is begun if one somewhat slower than the longest so far would
    // end in time: near cameras see more fur.
    const double left = f.quick ? kQuickSeconds - Seconds(start) : 1e9;
    if (left < kSlower * longest) {
      report->skipped.push_back(scenes[i].name + ": no time left for it in a quick run");
      continue;
    }
    report->options.secondsLeft = left / double(scenes.size() - i);
    Result<BenchSceneResult> result = [&] {
      ProgressBar bar(f.progress);
      const auto show = [&](const std::string& what, double share) { bar.Show(what, share); };
      return RunBenchScene(scenes[i], configs, devices, report->options, show);
    }();
    if (!result) return result.error();
    fmt::print("{}", BenchTable(*result));
    std::fflush(stdout);
    longest = std::max(longest, result->seconds);
    report->scenes.push_back(std::move(*result));
  }
  report->seconds = Seconds(start);
  if (report->scenes.empty())
    return Error{ErrorCode::InputMissing, "no scene could be measured: " + report->skipped.at(0)};
  for (const std::string& why : report->skipped) PrintMessages({"left out " + why});
  return Done{};
}

Result<Done> WriteReport(const BenchFlags& f, const BenchReport& report) {
  if (!f.json.empty())
    if (Result<Done> written = fur::WriteFile(f.json, BenchJson(report).dump(2) + "\n"); !written) return written;
  if (f.html.empty()) return Done{};
  const Result<std::string> html = BenchHtml(report);
  if (!html) return html.error();
  return fur::WriteFile(f.html, *html);
}

Result<nlohmann::json> ReadEarlier(const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) return Error{ErrorCode::InputMissing, file + ": no such file"};
  nlohmann::json j = nlohmann::json::parse(in, nullptr, false);
  if (!j.is_object()) return Error{ErrorCode::InputMalformed, file + ": is not JSON of fur bench"};
  return j;
}

Result<Done> CheckAgreement(const std::string& file, const BenchReport& report, const nlohmann::json& earlier) {
  const Result<BenchAgreement> agreement = CompareRatios(report, earlier);
  if (!agreement) return Error{agreement.error().code, file + ": " + agreement.error().message};
  fmt::print("{} of {} ratios agree with {} within their intervals\n", agreement->compared - agreement->apart.size(),
             agreement->compared, file);
  for (const std::string& line : agreement->apart) fmt::print("  apart: {}\n", line);
  if (agreement->apart.empty()) return Done{};
  return Error{ErrorCode::ComparisonFailed,
               fmt::format("{} ratios are apart from those of {}", agreement->apart.size(), file)};
}

// CLI11 cannot check a list.
Result<Done> CheckTechniques(const std::string& techniques) {
  std::istringstream in(techniques);
  for (std::string one; std::getline(in, one, ',');)
    if (one != "seed" && one != "shells")
      return Error{ErrorCode::Usage, "--techniques takes seed and shells, not '" + one + "'"};
  return Done{};
}

Result<Done> Bench(const BenchFlags& f) {
  if (Result<Done> known = CheckTechniques(f.techniques); !known) return known;
  if (Result<Done> ok = CheckFlags(f); !ok) return ok;
  if (f.list) {
    PrintList(f);
    return Done{};
  }
  Result<BenchOptions> options = MakeOptions(f);
  if (!options) return options.error();
  Result<nlohmann::json> earlier = nlohmann::json();
  if (!f.agree.empty()) earlier = ReadEarlier(f.agree);  // before long work
  if (!earlier) return earlier.error();
  BenchReport report{DescribeMachine(), LoadAverage()};
  report.quick = f.quick;
  report.options = *options;
  Devices devices;
  if (Result<Done> ok = OpenDevices(f, &devices); !ok) return ok;
  if (Result<Done> ok = RunScenes(f, devices.all, &report); !ok) return ok;
  if (IsBusy(report.machine, report.loadAtStart))
    fmt::print("the machine is busy (load {:.1f} on {} cores): ratios depend on the load too\n", report.loadAtStart,
               report.machine.cores);
  report.loadAtEnd = LoadAverage();
  if (Result<Done> ok = WriteReport(f, report); !ok) return ok;
  return f.agree.empty() ? Result<Done>(Done{}) : CheckAgreement(f.agree, report, *earlier);
}

void AddFlags(CLI::App* c, BenchFlags* f) {
  c->add_flag("--quick", f->quick,
              "Few scenes and configurations, small pictures and references; ends within 3 minutes");
  c->add_flag("--list", f->list, "Print the scenes and configurations, and measure nothing");
  c->add_option("--scenes", f->scenes, "Only these, as builtin-far,cat*");
  c->add_option("--configs", f->configs, "Only these, as shells-8,shells-no*; the seed technique is always there");
  c->add_option("--techniques", f->techniques, "Only these, of seed,shells; the seed technique is always there");
  c->add_option("--backend", f->backend, "vulkan, gl or both")
      ->check(CLI::IsMember({"vulkan", "gl", "both"}))
      ->capture_default_str();
  c->add_option("--adapter", f->adapter, "Part of an adapter's name (fur info lists them); default: the first");
  c->add_option("--size", f->size, "Width x height in pixels; default 1280x720, quick 320x180");
  c->add_option("--rounds", f->rounds, "Timed frames of each configuration; default 15, quick 9")
      ->check(CLI::Range(1u, 10000u));
  c->add_option("--spp", f->samples, "Samples a pixel of the references; default 64, quick 16")
      ->check(CLI::Range(2u, 65536u));
  c->add_option("--json", f->json, "JSON file for everything that was measured");
  c->add_option("--html", f->html, "Page with plots, tables, pictures and error maps");
  c->add_option("--agree", f->agree,
                "An earlier run's JSON: fail where a ratio's interval does not meet the one there");
  c->add_option("--assets", f->assets, "Folder of the models; what is not there is left out, in words")
      ->capture_default_str();
  c->add_option("--cache", f->cache, "Folder of references; default $XDG_CACHE_HOME/fur or ~/.cache/fur");
  c->add_flag("--no-cache", f->noCache, "Make every reference anew, and keep none");
  c->add_flag("--progress", f->progress, "Show the progress bar even where stderr is no terminal");
}

}  // namespace

void AddBenchCommand(CLI::App& app, Command* run) {
  auto flags = std::make_shared<BenchFlags>();
  CLI::App* c =
      app.add_subcommand("bench", "Measure run time against error over techniques, options, scenes and backends");
  AddFlags(c, flags.get());
  c->callback([flags, run] { *run = Running(flags, Bench); });
}

}  // namespace app
