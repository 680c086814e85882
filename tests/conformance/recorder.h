// What the running case read back and compared: for the report, and for Vulkan against GL. There is one recorder; it
// does nothing while no case runs (in programs other than fur_conformance).
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "comparison.h"
#include "names.h"

namespace conformance {

struct Compared {
  Outcome outcome;
  std::string tolerance;
  Unit unit = Unit::Lsb;
  double limit = 0;
  uint64_t allowed = 0;
  bool ok = true;
  Image result, reference;
};

// Vulkan against GL, over all that a case read back on both.
struct Parity {
  uint64_t pictures = 0, pixels = 0, differing = 0, beyond = 0;
  double worst = 0;
  const ParityLimit* limit = nullptr;
  std::optional<Compared> shown;  // the first that differs
  std::string problem;            // "" when all is within the limit
};

struct CaseRecord {
  CaseName name;
  uint64_t comparisons = 0;
  double worst = 0;              // by tolerance unit of the comparison it is from
  std::vector<Compared> kept;    // those that failed (four at most), or the one that is farthest off
  std::vector<Image> readBacks;  // in the order of reading
  std::optional<Parity> parity;  // of the second backend's case, and of cases of both
};

struct MeasuredTolerance {
  double worst = 0, differing = 0;  // the greatest distance; the greatest share of a picture's pixels
  uint64_t comparisons = 0;
};

class Recorder {
 public:
  void Begin(const CaseName&, const std::string& driver);
  // Compares with the other backend's case of the same name if that was the one before; then forgets the case.
  CaseRecord End(bool skipped);
  const std::string& Driver() const { return driver_; }  // "vulkan:lavapipe"; "" while no case runs
  bool Active() const { return active_; }
  const CaseName& Running() const { return case_.name; }

  void ReadBack(const Image&);
  void Add(Compared);
  // Within a case of both backends: GL's picture against Vulkan's.
  bool ComparesBackends() const { return active_ && case_.name.backend == "both"; }
  testing::AssertionResult Backends(const Image& gl, const Image& vulkan);
  void Measured(const Tolerance&, double distance, double differing = 0);
  // By tolerance name and driver, since the start.
  const std::map<std::pair<std::string, std::string>, MeasuredTolerance>& AllMeasured() const { return measured_; }

 private:
  bool active_ = false;
  std::string driver_;
  CaseRecord case_;
  std::optional<CaseRecord> before_;
  std::map<std::pair<std::string, std::string>, MeasuredTolerance> measured_;
};
Recorder& TheRecorder();

// What Vulkan and GL read back in one case. `driver` is the one that is not required, or either.
Parity CompareReadBacks(const CaseRecord& vulkan, const CaseRecord& gl, const std::string& driver);

}  // namespace conformance
