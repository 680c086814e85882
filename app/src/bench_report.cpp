#include "bench_report.h"

#include <fmt/format.h>

#include <map>

#include "stats.h"

namespace app {
namespace {

using Json = nlohmann::ordered_json;

Json ContextJson(const BenchReport& r) {
  const Machine& m = r.machine;
  return {{"host", m.host},
          {"system", m.system},
          {"cpu", m.cpu},
          {"cores", m.cores},
          {"build", m.build},
          {"compiler", m.compiler},
          {"version", m.version},
          {"date", m.date},
          {"command", m.command},
          {"load_at_start", r.loadAtStart},
          {"load_at_end", r.loadAtEnd},
          {"seconds", r.seconds}};
}

Json ReferenceJson(const BenchReference& r) {
  return {{"look", ToString(r.look)},    {"semantics", ToString(r.semantics)}, {"seconds", r.seconds},
          {"halves_flip", r.halvesFlip}, {"halves_rmse", r.halvesRmse},        {"mask_pixels", r.maskPixels}};
}

Json ErrorJson(const BenchResult& r) {
  const BenchError& e = r.error;
  return {{"mask_flip", e.maskFlip},
          {"mask_rmse", e.maskRmse},
          {"band_opacity_rmse", e.bandRmse ? Json(*e.bandRmse) : Json(nullptr)},
          {"rmse", e.rmse},
          {"flip", e.flip},
          {"flip_p99", e.flipP99},
          {"without_fins", r.errorWithoutFins}};
}

Json ResultJson(const BenchResult& r) {
  const fur::RenderSettings& s = r.config.settings;
  const fur::FrameCounts& c = r.counts;
  return {{"config", r.config.name},
          {"note", r.config.note},
          {"backend", r.backend},
          {"driver", r.driver},
          {"technique", ToString(s.technique)},
          {"look", ToString(s.look)},
          {"semantics", ToString(s.semantics)},
          {"shells", s.shells},
          {"samples", s.samples},
          {"default", r.config.isDefault},
          {"pareto", r.onFront},
          {"first_frame_ms", r.firstFrameMs},
          {"frame_ms", {{"median", r.ms.median}, {"q1", r.ms.q1}, {"q3", r.ms.q3}, {"rounds", r.frameMs}}},
          {"ratio",
           {{"median", r.ratio.median}, {"low", r.ratio.low}, {"high", r.ratio.high}, {"coverage", r.ratio.coverage}}},
          {"error", ErrorJson(r)},
          {"draws", c.draws},
          {"triangles", c.triangles},
          {"fragments", {{"base", c.baseFragments}, {"fins", c.finFragments}, {"shells", c.shellFragments}}}};
}

Json SceneJson(const BenchSceneResult& s) {
  Json j;
  j["name"] = s.scene.name;
  j["model"] = s.scene.file.empty() ? "built-in" : s.scene.file;
  j["animals"] = s.scene.animals;
  j["distance"] = s.scene.distance;
  j["angles"] = s.scene.angles;
  j["crop"] = s.scene.crop;
  j["seconds"] = s.seconds;
  j["references"] = Json::array();
  for (const BenchReference& r : s.references) j["references"].push_back(ReferenceJson(r));
  j["results"] = Json::array();
  for (const BenchResult& r : s.results) j["results"].push_back(ResultJson(r));
  j["skipped"] = s.skipped;
  return j;
}

std::string Key(const std::string& scene, const std::string& backend, const std::string& config) {
  return scene + " " + backend + " " + config;
}

// By Key. Throws nlohmann::json::exception for what is no report.
std::map<std::string, fur::BenchRatio> RatiosOf(const nlohmann::json& report) {
  std::map<std::string, fur::BenchRatio> ratios;
  for (const nlohmann::json& scene : report.at("scenes"))
    for (const nlohmann::json& r : scene.at("results")) {
      const nlohmann::json& ratio = r.at("ratio");
      ratios[Key(scene.at("name"), r.at("backend"), r.at("config"))] = {ratio.at("median"), ratio.at("low"),
                                                                        ratio.at("high"), ratio.at("coverage")};
    }
  return ratios;
}

}  // namespace

std::string RatioText(const fur::BenchRatio& r) {
  return fmt::format("{:.3f} ({:.3f}-{:.3f})", r.median, r.low, r.high);
}

Json BenchJson(const BenchReport& r) {
  Json j;
  j["fur_bench"] = 1;
  j["context"] = ContextJson(r);
  j["quick"] = r.quick;
  j["width"] = r.options.width;
  j["height"] = r.options.height;
  j["rounds"] = r.options.rounds;
  j["warm_up"] = r.options.warmUp;
  j["reference_samples"] = r.options.samples;
  j["scenes"] = Json::array();
  for (const BenchSceneResult& s : r.scenes) j["scenes"].push_back(SceneJson(s));
  j["skipped"] = r.skipped;
  return j;
}

std::string BenchTable(const BenchSceneResult& s) {
  std::string text = fmt::format("{} ({:.0f} s)\n", s.scene.name, s.seconds);
  for (const BenchReference& r : s.references)
    text += fmt::format("  reference {} {}: its halves differ by FLIP {:.4f}, RMSE {:.4f}\n", ToString(r.look),
                        ToString(r.semantics), r.halvesFlip, r.halvesRmse);
  text += fmt::format("  {:<7} {:<19} {:<14} {:>8} {:>17} {:>21} {:>7} {:>7} {:>7} {:>9}\n", "backend", "configuration",
                      "look", "ms", "quartiles", "time : seed (99 %)", "FLIP", "RMSE", "band", "fragments");
  for (const BenchResult& r : s.results) {
    const std::string look =
        fmt::format("{} {}", ToString(r.config.settings.look), ToString(r.config.settings.semantics));
    const std::string quartiles = fmt::format("{:.1f}-{:.1f}", r.ms.q1, r.ms.q3);
    const fur::FrameCounts& c = r.counts;
    text += fmt::format("{}{:<7} {:<19} {:<14} {:>8.2f} {:>17} {:>21} {:>7.4f} {:>7.4f} {:>7} {:>9}\n",
                        r.onFront ? "* " : "  ", r.backend, r.config.name, look, r.ms.median, quartiles,
                        RatioText(r.ratio), r.error.maskFlip, r.error.maskRmse,
                        r.error.bandRmse ? fmt::format("{:.4f}", *r.error.bandRmse) : "-",
                        c.baseFragments + c.finFragments + c.shellFragments);
  }
  text += "  * on the Pareto front of its look; shells is the default: the number of layers that the coat brings\n";
  for (const std::string& line : s.skipped) text += "  left out: " + line + "\n";
  return text;
}

fur::Result<BenchAgreement> CompareRatios(const BenchReport& report, const nlohmann::json& earlier) {
  std::map<std::string, fur::BenchRatio> before;
  try {
    before = RatiosOf(earlier);
  } catch (const nlohmann::json::exception&) {
    return fur::Error{fur::ErrorCode::InputMalformed, "is not a report of fur bench --json"};
  }
  BenchAgreement agreement;
  for (const auto& [key, now] : RatiosOf(BenchJson(report))) {
    const auto then = before.find(key);
    if (then == before.end()) continue;
    ++agreement.compared;
    const bool meet = now.low <= then->second.high && then->second.low <= now.high;
    if (!meet) agreement.apart.push_back(key + ": " + RatioText(now) + ", was " + RatioText(then->second));
  }
  if (agreement.compared == 0)
    return fur::Error{fur::ErrorCode::Usage, "has no scene and configuration in common with this run"};
  return agreement;
}

}  // namespace app
