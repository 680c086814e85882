// Patterns as fields over a body: the higher, the darker.
#pragma once

#include <vector>

#include "body.h"
#include "fur/markings.h"

namespace fur {

// Sites on the skin, none nearer to another than `distance`: what spots and rosettes stand around.
class Sites {
 public:
  Sites() = default;
  Sites(const std::vector<Place>& samples, double distance, uint32_t seed);

  // Distances to the two nearest that face the same way; HUGE_VAL where there is none near.
  struct Nearest {
    double first, second;
  };
  Nearest Find(const Place&) const;
  const std::vector<Place>& All() const { return sites_; }

 private:
  std::array<int, 3> CellOf(const glm::dvec3& p) const;
  size_t Bucket(const std::array<int, 3>& cell) const;

  double cell_ = 1;
  std::vector<Place> sites_;
  std::vector<std::vector<uint32_t>> buckets_;
};

// One layer's pattern on one body.
class PatternField {
 public:
  PatternField(const MarkingLayer&, const Body&);

  // 0..1, how much of the layer's colour stands there: pattern, taper, where and opacity.
  double Weight(const Place&) const;
  // Share of the skin whose field is lower, 0..1.
  double Rank(const Place&) const;

 private:
  double Value(const Place&) const;
  double Stripes(const Place&) const;
  double Streaks(const Place&) const;
  double Ring(const Place&) const;
  double Broken(double value, double strength, const Place&) const;
  double Ramps(const std::vector<BodyRamp>&, const Place&) const;

  MarkingLayer layer_;
  Sites sites_;
  std::vector<double> quantiles_;  // of the field over the body's samples, ascending
};

}  // namespace fur
