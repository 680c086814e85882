// The page of fur bench.
#include <fmt/format.h>

#include <algorithm>

#include "bench_plot.h"
#include "bench_report.h"
#include "fur/image_io.h"
#include "html_text.h"
#include "stats.h"

namespace app {
namespace {

using fur::Result;

constexpr const char* kStyle = R"(
:root{--ink:#1b1e24;--paper:#fff;--soft:#5a6270;--rule:#d9dde4;--band:#f4f6f9;--s0:#b3541e;--s1:#1f5fbf;
--s2:#2e7d4f;--s3:#8a3fa0}
@media (prefers-color-scheme:dark){:root{--ink:#e6e9ef;--paper:#15181d;--soft:#9aa4b2;--rule:#343a44;--band:#1d2128;
--s0:#f0955a;--s1:#7fb0ff;--s2:#6fcf97;--s3:#d59be6}}
*{box-sizing:border-box}
body{margin:0 auto;max-width:1360px;padding:24px;font:15px/1.5 system-ui,sans-serif;color:var(--ink);background:var(--paper)}
h1{font-size:26px;margin:0 0 4px}h2{font-size:20px;margin:40px 0 8px;padding-top:12px;border-top:1px solid var(--rule)}
p{max-width:90ch;margin:6px 0}.soft{color:var(--soft)}code{font-size:13px;overflow-wrap:anywhere}
table{border-collapse:collapse;font-variant-numeric:tabular-nums;font-size:13.5px}
th,td{padding:3px 8px;text-align:right;border-bottom:1px solid var(--rule);white-space:nowrap}
th{white-space:normal;color:var(--soft);font-weight:600;vertical-align:bottom}th.l,td.l{text-align:left}
tbody tr:nth-child(even){background:var(--band)}tr.default td{font-weight:700}
.wide{overflow-x:auto}.plots{display:flex;flex-wrap:wrap;gap:16px;margin:12px 0}
svg.plot{flex:1 1 520px;max-width:660px;min-width:320px;height:auto}
svg text{fill:var(--ink);font:11px system-ui,sans-serif}svg .tick,svg .axis{fill:var(--soft)}
svg .title{font-weight:600;font-size:13px}
.grid{stroke:var(--rule);stroke-width:1}.leader{stroke:var(--soft);stroke-width:.8}
.point,.ring,.front{stroke-width:1.8}.ring,.front{fill:none}.front{opacity:.65}
.s0{fill:var(--s0);stroke:var(--s0)}.s1{fill:var(--s1);stroke:var(--s1)}
.s2{fill:var(--s2);stroke:var(--s2)}.s3{fill:var(--s3);stroke:var(--s3)}
.hollow{fill:var(--paper)}.ring,.front{fill:none}
.gallery{display:grid;align-items:start;grid-template-columns:repeat(auto-fill,minmax(300px,1fr));gap:14px;margin:12px 0}
figure{margin:0;background:var(--band);padding:8px;border-radius:6px}figure div{display:flex;gap:6px}
figure img{width:calc(50% - 3px);height:auto;display:block}figure.one img{width:100%}
figcaption{font-size:13px;margin-top:5px;color:var(--soft)}figcaption b{color:var(--ink)}
)";

// Appends the picture; empty pictures are left out.
Result<fur::Done> AddPicture(const BenchPicture& p, const std::vector<uint8_t>& pixels, const std::string& alt,
                             std::string* html) {
  if (pixels.empty()) return fur::Done{};
  const Result<std::vector<uint8_t>> png = fur::EncodePng(p.width, p.height, pixels);
  if (!png) return png.error();
  *html += fmt::format("<img alt=\"{}\" width=\"{}\" height=\"{}\" src=\"data:image/png;base64,{}\">", Escaped(alt),
                       p.width, p.height, Base64(*png));
  return fur::Done{};
}

std::string LookName(fur::Look look, fur::Semantics semantics) {
  return std::string("look ") + ToString(look) + ", " + ToString(semantics);
}

std::string LookName(const fur::RenderSettings& s) { return LookName(s.look, s.semantics); }

std::vector<std::string> BackendsOf(const BenchSceneResult& s) {
  std::vector<std::string> names;
  for (const BenchResult& r : s.results)
    if (std::find(names.begin(), names.end(), r.backend) == names.end()) names.push_back(r.backend);
  return names;
}

std::string PlotOf(const BenchSceneResult& s, const std::string& backend) {
  Plot plot{s.scene.name + ", " + backend, {}, {}};
  for (const BenchReference& r : s.references) plot.series.push_back(LookName(r.look, r.semantics));
  for (const BenchResult& r : s.results) {
    if (r.backend != backend) continue;
    const auto series = std::find(plot.series.begin(), plot.series.end(), LookName(r.config.settings));
    plot.points.push_back({r.config.name, r.ms.median, r.error.maskFlip, size_t(series - plot.series.begin()),
                           r.onFront, r.config.isDefault, r.config.settings.technique == fur::Technique::Seed});
  }
  return PlotSvg(plot);
}

std::string Row(const BenchResult& r) {
  const BenchError& e = r.error;
  const fur::FrameCounts& c = r.counts;
  std::string row = fmt::format("<tr{}><td class=\"l\">{}</td><td class=\"l\">{}{}</td><td class=\"l\">{}</td>",
                                r.config.isDefault ? " class=\"default\"" : "", r.backend, Escaped(r.config.name),
                                r.config.isDefault ? " (default)" : "", LookName(r.config.settings));
  row += fmt::format("<td>{:.2f}</td><td>{:.2f}-{:.2f}</td><td>{:.3f}</td><td>{:.3f}-{:.3f}</td>", r.ms.median, r.ms.q1,
                     r.ms.q3, r.ratio.median, r.ratio.low, r.ratio.high);
  row += fmt::format("<td>{:.4f}{}</td><td>{:.4f}</td><td>{}</td><td>{}</td><td>{:.0f}</td><td>{}</td></tr>\n",
                     e.maskFlip, r.errorWithoutFins ? "<sup>1</sup>" : "", e.maskRmse,
                     e.bandRmse ? fmt::format("{:.4f}", *e.bandRmse) : "-",
                     c.baseFragments + c.finFragments + c.shellFragments, r.firstFrameMs, r.onFront ? "yes" : "");
  return row;
}

std::string Table(const BenchSceneResult& s) {
  std::string html =
      "<div class=\"wide\"><table><thead><tr><th class=\"l\">backend</th><th class=\"l\">configuration</th><th "
      "class=\"l\">look</th><th>ms</th>"
      "<th>quartiles</th><th>time : seed</th><th>99 % interval</th><th>FLIP, mask</th><th>RMSE, mask</th><th>opacity "
      "RMSE, band</th>"
      "<th>fragments</th><th>first frame, ms</th><th>on the front</th></tr></thead><tbody>\n";
  for (const BenchResult& r : s.results) html += Row(r);
  html += "</tbody></table></div>\n";
  const bool bare =
      std::any_of(s.results.begin(), s.results.end(), [](const BenchResult& r) { return r.errorWithoutFins; });
  if (bare)
    html += "<p class=\"soft\"><sup>1</sup> without its fins, which make it worse here; the time is with them.</p>\n";
  return html;
}

Result<std::string> Gallery(const BenchSceneResult& s) {
  std::string html = "<div class=\"gallery\">\n";
  for (const BenchReference& r : s.references) {
    html += "<figure class=\"one\"><div>";
    if (Result<fur::Done> added = AddPicture(r.picture, r.picture.frame, "reference", &html); !added)
      return added.error();
    html +=
        fmt::format("</div><figcaption><b>reference</b>, {}</figcaption></figure>\n", LookName(r.look, r.semantics));
  }
  for (const BenchResult& r : s.results) {
    if (r.picture.frame.empty()) continue;
    html += "<figure><div>";
    for (const auto& [pixels, what] : {std::pair{&r.picture.frame, "picture"}, {&r.picture.heat, "error map"}})
      if (Result<fur::Done> added = AddPicture(r.picture, *pixels, r.config.name + ": " + what, &html); !added)
        return added.error();
    html += fmt::format("</div><figcaption><b>{}</b> {}; FLIP {:.4f}</figcaption></figure>\n", Escaped(r.config.name),
                        Escaped(r.config.note), r.error.maskFlip);
  }
  return html + "</div>\n";
}

std::string Noise(const BenchSceneResult& s) {
  std::string text;
  for (const BenchReference& r : s.references)
    text += fmt::format("{}{}: FLIP {:.4f}, RMSE {:.4f}", text.empty() ? "" : "; ", LookName(r.look, r.semantics),
                        r.halvesFlip, r.halvesRmse);
  return "<p class=\"soft\">Two halves of the reference's samples differ by: " + text + ".</p>\n";
}

Result<std::string> Scene(const BenchSceneResult& s) {
  std::string html = fmt::format("<section id=\"{0}\"><h2>{0}</h2>\n", Escaped(s.scene.name));
  html += fmt::format(
      "<p class=\"soft\">{}, {} animal{}, eye at {} of the framing distance, {}; {:.0f} % of the picture is "
      "scored.</p>\n",
      Escaped(s.scene.file.empty() ? "built-in animal" : s.scene.file), s.scene.animals, s.scene.animals > 1 ? "s" : "",
      s.scene.distance,
      s.scene.angles > 1 ? fmt::format("{} angles of a turntable", s.scene.angles) : std::string("still"),
      100 * s.scene.crop[2] * s.scene.crop[3]);
  html += Noise(s) + "<div class=\"plots\">\n";
  for (const std::string& backend : BackendsOf(s)) html += PlotOf(s, backend);
  html += "</div>\n" + Table(s);
  for (const std::string& line : s.skipped) html += "<p class=\"soft\">Left out: " + Escaped(line) + "</p>\n";
  Result<std::string> gallery = Gallery(s);
  if (!gallery) return gallery.error();
  return html + *gallery + "</section>\n";
}

std::string Context(const BenchReport& r) {
  const Machine& m = r.machine;
  std::string html = "<table><tbody>\n";
  const auto row = [&](const char* name, const std::string& value) {
    html += fmt::format("<tr><td class=\"l\">{}</td><td class=\"l\" style=\"white-space:normal\">{}</td></tr>\n", name,
                        Escaped(value));
  };
  row("machine", fmt::format("{}, {} cores; {}; {}", m.cpu, m.cores, m.system, m.host));
  row("load", fmt::format("{:.2f} at the start, {:.2f} at the end{}", r.loadAtStart, r.loadAtEnd,
                          IsBusy(m, r.loadAtStart) ? ": the machine was busy, and ratios depend on the load too" : ""));
  std::vector<std::string> seen;
  for (const BenchSceneResult& s : r.scenes)
    for (const BenchResult& result : s.results) {
      if (std::find(seen.begin(), seen.end(), result.backend) != seen.end()) continue;
      seen.push_back(result.backend);
      row(result.backend == "gl" ? "OpenGL driver" : "Vulkan driver", result.driver);
    }
  row("program", fmt::format("fur {}, {} build, {}", m.version, m.build, m.compiler));
  row("date", fmt::format("{}; {:.0f} s in all", m.date, r.seconds));
  row("command", m.command);
  row("measured", fmt::format("{}x{}, {} rounds after {} to warm up, references of {} samples a pixel", r.options.width,
                              r.options.height, r.options.rounds, r.options.warmUp, r.options.samples));
  return html + "</tbody></table>\n";
}

}  // namespace

Result<std::string> BenchHtml(const BenchReport& r) {
  std::string html =
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><meta name=\"viewport\" "
      "content=\"width=device-width,initial-scale=1\">"
      "<meta name=\"color-scheme\" content=\"light dark\"><title>fur bench</title><style>";
  html += kStyle;
  html += "</style></head><body>\n<h1>Run time against error</h1>\n" + Context(r);
  html +=
      "<p>Each frame is timed from its first call to the finished GPU; the configurations take turns. <b>time : "
      "seed</b> is the median of the ratios to the "
      "published technique (square) within a round, on the same backend, with an interval that holds the true median "
      "with 99 % probability where there are at "
      "least 8 rounds. Errors are against a reference of the same look and semantics: compare configurations of one "
      "colour only. Filled points are on "
      "the Pareto front of their colour; the ring is the default, what <code>fur render</code> does without flags: it "
      "is the number of layers that a coat brings. "
      "Error maps: FLIP, white at .25.</p>\n";
  for (const BenchSceneResult& s : r.scenes) {
    Result<std::string> scene = Scene(s);
    if (!scene) return scene.error();
    html += *scene;
  }
  for (const std::string& line : r.skipped) html += "<p class=\"soft\">Left out: " + Escaped(line) + "</p>\n";
  return html + "</body></html>\n";
}

}  // namespace app
