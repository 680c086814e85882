// Run time against error: what `fur bench` measures, as data, and the statistics of what it measured. docs/bench.md.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "fur/renderer.h"

namespace fur {

// What is seen.
struct BenchScene {
  std::string name;  // "cat-25-near-turntable"
  std::string file;  // below the folder of assets; empty: the built-in animal
  uint32_t animals = 1;
  double distance = 1;                     // of the eye from the target, in that of the framing camera
  uint32_t angles = 1;                     // cameras about the up axis, evenly spaced, that are scored; 1: still
  std::array<double, 4> crop{0, 0, 1, 1};  // left, top, width, height of the part that is scored, of the picture's
  bool quick = false;                      // in `--quick` too
};

// How it is drawn. Size, background and light are the run's.
struct BenchConfig {
  std::string name, note;
  RenderSettings settings;
  bool quick = false;
  bool isDefault = false;  // what `fur render` does without flags
};

// The same order and names in every run. The first configuration is the baseline: the seed technique with its fins.
std::vector<BenchScene> BenchScenes();
std::vector<BenchConfig> BenchConfigs();

// Whether one of the comma-separated `patterns` is the name, or ends in * and starts it. No patterns: true.
bool MatchesAny(const std::string& name, const std::string& patterns);

// 0 for none; the mean of the two middle ones of an even number.
double Median(std::vector<double> values);

// Quartiles by linear interpolation at (n - 1) p of the sorted values (type 7 of Hyndman and Fan, "Sample Quantiles in
// Statistical Packages", 1996). 0 for none.
struct BenchSummary {
  double median = 0, q1 = 0, q3 = 0;
};
BenchSummary Summarise(std::vector<double> values);

// The median of a[i] / b[i], pairs of one round each, so that what slows a whole round cancels; and the interval of
// order statistics that holds the true median with at least the wanted probability whatever the distribution is: x(k)
// .. x(n+1-k) does with 1 - 2 P(Binomial(n, 1/2) < k) (David and Nagaraja, "Order Statistics", 7.1). With too few pairs
// for it: least and largest, and what probability those have.
struct BenchRatio {
  double median = 0, low = 0, high = 0, coverage = 0;
};
BenchRatio PairedRatio(std::span<const double> a, std::span<const double> b, double wanted = 0.99);

// For each point whether no other one is at least as good in both and better in one. x: time, y: error.
struct BenchPoint {
  double x = 0, y = 0;
};
std::vector<bool> ParetoFront(std::span<const BenchPoint> points);

}  // namespace fur
