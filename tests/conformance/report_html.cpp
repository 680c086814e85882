// The page: one row for each case, with the pictures of what it compared. It needs no other file and no network.
#include <fmt/format.h>

#include <set>
#include <sstream>

#include "../../app/src/html_text.h"
#include "report.h"

namespace conformance {
namespace {

using app::Escaped;

constexpr const char* kStyle = R"(
:root{--ink:#1b1e24;--paper:#fff;--soft:#5a6270;--rule:#d9dde4;--band:#f4f6f9;--good:#1d7a3e;--bad:#b3261e;--skip:#8a6100}
@media (prefers-color-scheme:dark){:root{--ink:#e6e9ef;--paper:#15181d;--soft:#9aa4b2;--rule:#343a44;--band:#1d2128;
--good:#6fcf97;--bad:#ff8a80;--skip:#e6b450}}
*{box-sizing:border-box}
body{margin:0 auto;max-width:1360px;padding:24px;font:15px/1.5 system-ui,sans-serif;color:var(--ink);background:var(--paper)}
h1{font-size:26px;margin:0 0 4px}p{margin:4px 0}.soft{color:var(--soft)}code{font-size:13px;overflow-wrap:anywhere}
form{position:sticky;top:0;z-index:1;display:flex;flex-wrap:wrap;gap:14px;align-items:center;padding:10px 0;margin:12px 0;
background:var(--paper);border-bottom:1px solid var(--rule)}
select,input{font:inherit;color:inherit;background:var(--band);border:1px solid var(--rule);border-radius:4px;padding:3px 6px}
table{border-collapse:collapse;width:100%;font-size:13.5px;table-layout:fixed}
th,td{padding:4px 8px;text-align:left;vertical-align:top;border-bottom:1px solid var(--rule);overflow-wrap:anywhere}
th{color:var(--soft);font-weight:600}td.n{text-align:right;font-variant-numeric:tabular-nums}
.passed .r{color:var(--good)}.FAILED .r{color:var(--bad);font-weight:700}.skipped .r{color:var(--skip)}
.FAILED{background:color-mix(in srgb,var(--bad) 9%,transparent)}
.pics{display:flex;flex-wrap:wrap;gap:6px}figure{margin:0}figcaption{font-size:11px;color:var(--soft)}
img{display:block;width:96px;height:auto;max-height:128px;object-fit:contain;image-rendering:pixelated;background:#808080;
border:1px solid var(--rule)}
pre{margin:4px 0;white-space:pre-wrap;font-size:12px}.problem{color:var(--bad);font-weight:700}
)";

// Filters by what the form says; counts what is shown. Pictures are only decoded when their row comes into view.
constexpr const char* kScript = R"(
const form=document.forms[0],rows=[...document.querySelectorAll('tbody tr')];
function show(){
  const {area,driver,result,name}=form.elements;let shown=0;
  for(const r of rows){
    const ok=(!area.value||r.dataset.area==area.value)&&(!driver.value||r.dataset.driver.split(' ').includes(driver.value))&&
      (!result.value||r.dataset.result==result.value)&&r.dataset.name.includes(name.value.trim());
    r.hidden=!ok;shown+=ok;
  }
  document.getElementById('shown').textContent=shown+' of '+rows.length+' cases';
}
form.addEventListener('input',show);form.addEventListener('submit',e=>e.preventDefault());
if(location.hash.startsWith('#')&&location.hash.length>1)
  for(const [k,v] of new URLSearchParams(location.hash.slice(1)))if(form.elements[k])form.elements[k].value=v;
show();
)";

std::string Select(const char* name, const char* label, const std::set<std::string>& values) {
  std::string html = fmt::format("<label>{} <select name=\"{}\"><option value=\"\">all</option>", label, name);
  for (const std::string& v : values) html += fmt::format("<option>{}</option>", Escaped(v));
  return html + "</select></label>\n";
}

std::string Form(const Run& run) {
  std::set<std::string> areas, drivers, results;
  for (const CaseResult& c : run.cases) {
    areas.insert(c.name.area);
    std::istringstream keys(c.driver);  // of both: two
    for (std::string key; keys >> key;) drivers.insert(key);
    results.insert(ToString(c.result));
  }
  return "<form>" + Select("area", "Area", areas) + Select("driver", "Driver", drivers) +
         Select("result", "Result", results) +
         "<label>Name has <input name=\"name\" size=\"24\"></label><span id=\"shown\" class=\"soft\"></span></form>\n";
}

std::string Figure(const std::string& uri, const std::string& what) {
  if (uri.empty()) return "";
  return fmt::format("<figure><img loading=\"lazy\" alt=\"{0}\" src=\"{1}\"><figcaption>{0}</figcaption></figure>",
                     what, uri);
}

std::string Of(const Pictures& p) {
  const Compared& c = p.numbers;
  std::string html = "<div class=\"pics\">" + Figure(p.reference, "reference") + Figure(p.result, "result") +
                     Figure(p.difference, "difference x16") + Figure(p.flip, "FLIP") + "</div>";
  return html + fmt::format(
                    "<div class=\"soft\">{} x {}; {}: {} of {} pixels differ, {} beyond {:g}, worst {:g} {}; "
                    "FLIP {:.4f}</div>",
                    p.width, p.height, Escaped(c.tolerance), c.outcome.differing, c.outcome.pixels, c.outcome.beyond,
                    c.limit, c.outcome.worst, ToString(c.unit), p.flipMean);
}

std::string OfParity(const Parity& p) {
  if (!p.limit->Compared())
    return fmt::format("<div class=\"soft\">Vulkan against GL: not compared: {}</div>", Escaped(p.limit->cause));
  if (p.pictures == 0) return "";
  return fmt::format("<div class=\"soft\">Vulkan against GL: {} pictures, {} of {} pixels differ</div>", p.pictures,
                     p.differing, p.pixels);
}

std::string Row(const CaseResult& c) {
  std::string details;
  if (c.result == Result::Skipped) details += "<div>" + Escaped(c.skip) + "</div>";
  for (const std::string& f : c.failures) details += "<pre>" + Escaped(f) + "</pre>";
  if (c.hasParity) details += OfParity(c.parity);
  for (const Pictures& p : c.pictures) details += Of(p);
  return fmt::format(
      "<tr class=\"{0}\" data-area=\"{1}\" data-driver=\"{2}\" data-result=\"{0}\" data-name=\"{3}\">"
      "<td>{3}</td><td>{2}</td><td class=\"r\">{0}</td><td class=\"n\">{4:.3f}</td><td>{5}</td></tr>\n",
      ToString(c.result), Escaped(c.name.area), Escaped(c.driver), Escaped(c.name.Full()), c.seconds, details);
}

std::string Head(const Run& run) {
  std::string html = fmt::format(
      "<h1>fur_conformance</h1>\n<p><b>{}</b> cases: <b>{}</b> passed, <b>{}</b> failed, <b>{}</b> skipped in {:.1f} "
      "s; {}</p>\n",
      run.cases.size(), run.Count(Result::Passed), run.Count(Result::Failed), run.Count(Result::Skipped), run.seconds,
      run.date);
  for (const DriverInfo& d : run.drivers)
    html += d.present ? fmt::format("<p>{}: {}, {}</p>\n", d.key, Escaped(d.adapter), Escaped(d.driver))
                      : fmt::format("<p>{}: not there: {}</p>\n", d.backend, Escaped(d.problem));
  html += "<p><code>" + Escaped(run.command) + "</code></p>\n";
  for (const std::string& p : run.problems) html += "<p class=\"problem\">" + Escaped(p) + "</p>\n";
  return html;
}

}  // namespace

std::string Html(const Run& run) {
  std::string html = fmt::format(
      "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><meta name=\"viewport\" "
      "content=\"width=device-width\"><title>fur_conformance</title><style>{}</style></head><body>\n",
      kStyle);
  html += Head(run) + Form(run);
  html +=
      "<table><colgroup><col style=\"width:25%\"><col style=\"width:11%\"><col style=\"width:6%\"><col "
      "style=\"width:6%\">"
      "<col></colgroup><thead><tr><th>Case</th><th>Driver</th><th>Result</th><th>s</th><th>Compared</th></tr></thead>"
      "<tbody>\n";
  for (const CaseResult& c : run.cases) html += Row(c);
  return html + "</tbody></table>\n<script>" + kScript + "</script></body></html>\n";
}

}  // namespace conformance
