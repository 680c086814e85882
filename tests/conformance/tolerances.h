// What may differ, by how much, and why. Everything else is exact.
#pragma once

#include <cstdint>
#include <span>
#include <string>

namespace conformance {

// Steps of an integer component; units in the last place of a 32-bit float; the value itself.
enum class Unit { Lsb, Ulp, Value };
const char* ToString(Unit);

struct Tolerance {
  const char* name;
  const char* cases;    // glob of the cases that use it, as area.case/parameter
  const char* drivers;  // glob of the drivers it holds for, as "vulkan:lavapipe"; the first row that fits counts
  Unit unit;
  double limit;     // of a component's distance from its oracle
  uint64_t pixels;  // that may be farther than that
  double floor;     // Ulp: of the larger of |expected| and this (the greatest value of the computation)
  double measured;  // the greatest distance that was seen on these drivers
  const char* cause;
  double differing = 1, measuredDiffering = 1;  // share of the pixels that may differ at all, 0..1; what was seen
};
inline constexpr Tolerance kExact{"exact", "*", "*", Unit::Lsb, 0, 0, 0, 0, ""};

std::span<const Tolerance> Tolerances();
// The row of this name for the driver that the running case is for; kExact where there is none for that driver. Throws
// std::runtime_error for an unknown name, and in a case that the row is not for.
const Tolerance& Within(const std::string& name);

// Pictures that Vulkan and GL read back with other bytes: for each, which cases, on which drivers, how far and why.
struct ParityLimit {
  const char* cases;    // glob of area.case/parameter
  const char* drivers;  // glob of the drivers beside the required one
  double steps;         // of a component (ULP of floats)
  double differing;     // share of the pixels that may differ, 0..1
  double beyond;        // share of the pixels that may be farther off than `steps`, 0..1; kNotCompared: anything goes
  double measuredSteps, measuredDiffering, measuredBeyond;  // of the case that is farthest off
  const char* cause;
  static constexpr double kNotCompared = 2;
  bool Compared() const { return beyond < kNotCompared; }
};
std::span<const ParityLimit> ParityLimits();
// The first row that fits; no difference at all where none does.
const ParityLimit& ParityLimitOf(const std::string& name, const std::string& driver);

// A limit may not be wider than what was measured asks for: this says what is wrong with a row, or "".
// `differing`: share of the pixels that differed.
std::string Slack(const Tolerance&, double measured, double differing = 1);

}  // namespace conformance
