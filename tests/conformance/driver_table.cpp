#include "driver_table.h"

#include <fmt/format.h>

#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <stdexcept>

#include "names.h"

namespace conformance {
namespace {

using nlohmann::json;

struct Fault {
  std::string drivers, cases, cause;
};

// driver_faults.txt: `DRIVERS CASES CAUSE...`.
std::vector<Fault> Faults() {
  std::vector<Fault> all;
  std::istringstream lines(
#include "conformance/driver_faults.inc"
  );
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line.substr(0, line.find('#')));
    Fault f;
    if (words >> f.drivers >> f.cases && std::getline(words >> std::ws, f.cause)) all.push_back(f);
  }
  return all;
}

std::string CauseOf(const std::string& driver, const std::string& name) {
  for (const Fault& f : Faults())
    if (MatchesGlob(f.drivers, driver) && MatchesGlob(f.cases, name)) return f.cause;
  return "cause unknown";
}

json Read(const std::string& file) {
  std::ifstream in(file);
  const json j = json::parse(in, nullptr, false);
  if (j.is_discarded() || !j.contains("fur_conformance"))
    throw std::runtime_error(file + " is no report of fur_conformance");
  return j;
}

// The drivers that a run was made for: those that are not required; both where both are the required ones.
std::vector<json> SubjectsOf(const json& run) {
  const json &vulkan = run["drivers"][0], &gl = run["drivers"][1];
  const bool oddVulkan = vulkan["present"] == true && vulkan["key"] != "vulkan:lavapipe";
  const bool oddGl = gl["present"] != true || gl["key"] != "gl:llvmpipe";
  if (oddVulkan == oddGl) return {vulkan, gl};
  return {oddVulkan ? vulkan : gl};
}

struct Tally {
  uint64_t passed = 0, failed = 0, skipped = 0, pairs = 0, differing = 0, pixels = 0, differingPixels = 0;
};

bool Has(const json& c, const std::string& driver) {
  return (" " + c["driver"].get<std::string>() + " ").find(" " + driver + " ") != std::string::npos;
}

Tally Count(const json& run, const std::string& driver) {
  Tally t;
  for (const json& c : run["cases"]) {
    if (Has(c, driver)) ++(c["result"] == "passed" ? t.passed : c["result"] == "FAILED" ? t.failed : t.skipped);
    if (!c.contains("vulkan_against_gl") || c["vulkan_against_gl"]["pixels"] == 0) continue;
    if (c["case"].get<std::string>().ends_with("_is_caught")) continue;  // planted
    const json& p = c["vulkan_against_gl"];
    ++t.pairs;
    t.differing += p["differing"] > 0;
    t.pixels += p["pixels"].get<uint64_t>();
    t.differingPixels += p["differing"].get<uint64_t>();
  }
  return t;
}

std::string Line(const json& driver, const Tally& t) {
  const double share = t.pixels ? 100.0 * double(t.differingPixels) / double(t.pixels) : 0;
  return fmt::format("| {} | {}, {} | {} | {} | {} | {} of {} | {:.3g} % |\n", driver["key"].get<std::string>(),
                     driver["adapter"].get<std::string>(), driver["driver"].get<std::string>(), t.passed, t.failed,
                     t.skipped, t.differing, t.pairs, share);
}

std::string Details(const json& run, const std::string& driver) {
  std::map<std::string, std::set<std::string>> skips;
  std::string text;
  for (const json& c : run["cases"]) {
    if (!Has(c, driver)) continue;
    const std::string name = c["area"].get<std::string>() + "." + c["case"].get<std::string>();
    if (c["result"] == "FAILED")
      text += fmt::format("* failed: `{}`: {}\n", c["name"].get<std::string>(), CauseOf(driver, c["name"]));
    if (c["result"] == "skipped") skips[c["skip"]].insert(name);
  }
  for (const auto& [reason, names] : skips) {
    text += fmt::format("* skipped, {}:", reason);
    for (const std::string& n : names) text += " `" + n + "`";
    text += "\n";
  }
  for (const Fault& f : Faults()) {
    const auto ran = [&](const json& c) { return MatchesGlob(f.cases, c["name"]); };
    if (MatchesGlob(f.drivers, driver) && std::none_of(run["cases"].begin(), run["cases"].end(), ran))
      text += fmt::format("* not run: `{}`: {}\n", f.cases, f.cause);
  }
  return text.empty() ? "" : "\n### " + driver + "\n\n" + text;
}

std::string RefusedLine(const json& driver) {
  std::string why = driver["problem"];
  why = why.substr(why.rfind("error "));
  while (!why.empty() && why.back() == '\n') why.pop_back();
  return fmt::format("| {} | refused: {} | - | - | - | - | - |\n", driver["backend"].get<std::string>(), why);
}

}  // namespace

std::string DriverTable(const std::vector<std::string>& files) {
  std::string table, details;
  for (const std::string& file : files) {
    const json run = Read(file);
    for (const json& subject : SubjectsOf(run)) {
      if (subject["present"] != true) {
        table += RefusedLine(subject);
        continue;
      }
      const std::string key = subject["key"];
      table += Line(subject, Count(run, key));
      details += Details(run, key);
    }
  }
  return "# Drivers\n\nMade by `tools/drivers.sh` from runs of `fur_conformance` on the drivers of one machine. The "
         "last two columns\n"
         "compare what Vulkan and GL read back in the same cases: the driver of the line beside lavapipe (GL drivers) "
         "or beside\n"
         "llvmpipe (Vulkan drivers), whose bytes are the same; of hardware its two drivers beside each other. Limits and "
         "causes of each\ndifference: `fur_conformance --tolerances`.\n\n"
         "| driver | adapter, version | passed | failed | skipped | cases that differ | pixels that differ |\n"
         "|---|---|---|---|---|---|---|\n" +
         table + details;
}

}  // namespace conformance
