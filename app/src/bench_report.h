// What fur bench found, as JSON, as a table and as a page.
#pragma once

#include <nlohmann/json.hpp>

#include "bench_run.h"
#include "machine.h"

namespace app {

struct BenchReport {
  Machine machine;
  double loadAtStart = 0, loadAtEnd = 0, seconds = 0;
  bool quick = false;
  BenchOptions options;
  std::vector<BenchSceneResult> scenes;
  std::vector<std::string> skipped;  // scenes, and why
};

nlohmann::ordered_json BenchJson(const BenchReport&);
std::string BenchTable(const BenchSceneResult&);

// One file that needs no other and no network.
fur::Result<std::string> BenchHtml(const BenchReport&);

// One line for each ratio whose interval does not meet that of the same configuration in an earlier run's JSON, and how
// many were compared. Usage where the JSON is no such report or has nothing in common with this one.
struct BenchAgreement {
  uint32_t compared = 0;
  std::vector<std::string> apart;
};
fur::Result<BenchAgreement> CompareRatios(const BenchReport&, const nlohmann::json& earlier);

// "0.45 (0.44-0.47)"
std::string RatioText(const fur::BenchRatio&);

}  // namespace app
