// Everything that a run knows, but for pictures.
#include <cmath>
#include <nlohmann/json.hpp>

#include "report.h"

namespace conformance {
namespace {

using nlohmann::ordered_json;

ordered_json Number(double v) { return std::isfinite(v) ? ordered_json(v) : ordered_json("infinite"); }

ordered_json Of(const DriverInfo& d) {
  if (!d.present) return {{"backend", d.backend}, {"present", false}, {"problem", d.problem}};
  return {{"backend", d.backend}, {"present", true}, {"key", d.key}, {"adapter", d.adapter}, {"driver", d.driver}};
}

ordered_json Of(const Parity& p) {
  return {{"pictures", p.pictures},          {"pixels", p.pixels},
          {"differing", p.differing},        {"beyond", p.beyond},
          {"worst", Number(p.worst)},        {"compared", p.limit->Compared()},
          {"steps", p.limit->steps},         {"differing_limit", p.limit->differing},
          {"beyond_limit", p.limit->beyond}, {"cause", p.limit->cause}};
}

ordered_json Of(const CaseResult& c) {
  ordered_json j{{"name", c.name.Full()},         {"area", c.name.area},          {"case", c.name.test},
                 {"parameter", c.name.parameter}, {"backend", c.name.backend},    {"driver", c.driver},
                 {"gtest", c.name.gtest},         {"result", ToString(c.result)}, {"seconds", c.seconds},
                 {"comparisons", c.comparisons},  {"worst", Number(c.worst)}};
  if (c.result == Result::Skipped) j["skip"] = c.skip;
  if (!c.failures.empty()) j["failures"] = c.failures;
  if (c.hasParity) j["vulkan_against_gl"] = Of(c.parity);
  return j;
}

ordered_json OfTolerances(const Run& run) {
  ordered_json all = ordered_json::array();
  for (const auto& [key, m] : run.measured)
    all.push_back(
        {{"name", key.first}, {"driver", key.second}, {"worst", Number(m.worst)}, {"comparisons", m.comparisons}});
  return all;
}

}  // namespace

std::string Json(const Run& run) {
  ordered_json j{{"fur_conformance", 1}, {"date", run.date}, {"command", run.command}, {"seconds", run.seconds}};
  j["drivers"] = {Of(run.drivers[0]), Of(run.drivers[1])};
  j["passed"] = run.Count(Result::Passed);
  j["failed"] = run.Count(Result::Failed);
  j["skipped"] = run.Count(Result::Skipped);
  j["not_run"] = run.notRun;
  j["problems"] = run.problems;
  j["tolerances"] = OfTolerances(run);
  j["cases"] = ordered_json::array();
  for (const CaseResult& c : run.cases) j["cases"].push_back(Of(c));
  return j.dump(1, ' ', false, ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace conformance
