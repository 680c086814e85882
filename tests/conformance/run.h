// Which cases run, and what became of each.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "drivers.h"
#include "recorder.h"

namespace conformance {

struct Options {
  std::string filter = "*";           // globs with commas between, of conformance names or GoogleTest's
  uint32_t shard = 1, shards = 1;     // this one, of so many
  std::vector<std::string> required;  // "vulkan:llvmpipe": backend and part of an adapter's name or driver key
  std::vector<std::string> adapters;  // "vulkan:NAME", "gl:NAME" or "NAME" for both
  std::string json, junit, html;      // files; "": not written
  std::string readBacks;              // a file for the bytes that the cases read back
  std::string command;                // as it was typed, for the report
};

enum class Result { Passed, Failed, Skipped };
const char* ToString(Result);

// Pictures of a comparison as PNG data URIs.
struct Pictures {
  uint32_t width = 0, height = 0;
  std::string reference, result, difference, flip;
  double flipMean = 0;
  Compared numbers;  // without its images
};

struct CaseResult {
  CaseName name;
  std::string driver;  // DriverLabelOf
  Result result = Result::Passed;
  double seconds = 0;
  std::vector<std::string> failures;
  std::string skip;
  uint64_t comparisons = 0;
  double worst = 0;
  std::vector<Pictures> pictures;
  bool hasParity = false;
  Parity parity;  // without its images
};

struct Run {
  std::array<DriverInfo, 2> drivers;  // Vulkan, GL
  std::vector<CaseResult> cases;
  uint64_t notRun = 0;                // selected, but for a backend that is not there
  std::vector<std::string> problems;  // of the run as a whole
  std::map<std::pair<std::string, std::string>, MeasuredTolerance> measured;
  std::vector<uint8_t> readBacks;  // where the options ask for them
  double seconds = 0;
  std::string command, date;
  uint64_t Count(Result) const;
  bool Ok() const { return problems.empty() && Count(Result::Failed) == 0; }
};

// The cases that the filter and the shard leave. A case and its twin on the other backend are in one shard.
std::vector<CaseName> Selected(const std::vector<CaseName>& all, const Options&);
// Names that stand for two cases, or "".
std::string Duplicates(const std::vector<CaseName>&);

// Makes a device on each backend and tells SetDrivers.
std::array<DriverInfo, 2> ProbeDrivers(const Options&);
// What is required and not there, in words; "" when all is.
std::string MissingDrivers(const std::array<DriverInfo, 2>&, const Options&);

const char* RunningCase();  // its name; safe within a signal handler

// Runs them; prints each that fails or is skipped.
Run RunCases(const std::vector<CaseName>&, const std::array<DriverInfo, 2>&, const Options&);

}  // namespace conformance
