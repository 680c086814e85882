#include "comparison.h"

#include <algorithm>
#include <limits>

#include "recorder.h"

namespace conformance {
namespace {

double HalfToDouble(uint16_t half) {
  const int exponent = half >> 10 & 31, mantissa = half & 1023;
  const double sign = half & 0x8000 ? -1 : 1;
  if (exponent == 31) return mantissa ? NAN : sign * INFINITY;
  return sign * (exponent ? std::ldexp(1024 + mantissa, exponent - 25) : std::ldexp(mantissa, -24));
}

template <class T>
double DistanceAt(const uint8_t* a, const uint8_t* b, uint32_t bytes) {
  double worst = 0;
  for (uint32_t i = 0; i + sizeof(T) <= bytes; i += sizeof(T)) {
    T x, y;
    std::memcpy(&x, a + i, sizeof x);
    std::memcpy(&y, b + i, sizeof y);
    if constexpr (std::is_floating_point_v<T>)
      worst = std::max(worst, UlpDistance(x, y));
    else
      worst = std::max(worst, Distance(double(x), double(y)));
  }
  return worst;
}

// Of halfs in their own units in the last place: their bits count them.
double HalfDistance(const uint8_t* a, const uint8_t* b, uint32_t bytes) {
  double worst = 0;
  for (uint32_t i = 0; i + 2 <= bytes; i += 2) {
    uint16_t x, y;
    std::memcpy(&x, a + i, 2);
    std::memcpy(&y, b + i, 2);
    if (x == y) continue;
    if (std::isnan(HalfToDouble(x)) || std::isnan(HalfToDouble(y))) return INFINITY;
    const auto ordered = [](uint16_t h) { return h & 0x8000 ? -double(h & 0x7FFF) : double(h); };
    worst = std::max(worst, std::abs(ordered(x) - ordered(y)));
  }
  return worst;
}

double TexelDistance(const uint8_t* a, const uint8_t* b, uint32_t bytes, Component component) {
  switch (component) {
    case Component::U8: return DistanceAt<uint8_t>(a, b, bytes);
    case Component::U16: return DistanceAt<uint16_t>(a, b, bytes);
    case Component::U32: return DistanceAt<uint32_t>(a, b, bytes);
    case Component::F32: return DistanceAt<float>(a, b, bytes);
    case Component::F16: return HalfDistance(a, b, bytes);
    case Component::Packed: return INFINITY;
  }
  return INFINITY;
}

bool SameShape(const Image& a, const Image& b) {
  return a.width == b.width && a.height == b.height && a.texelBytes == b.texelBytes && a.bytes.size() == b.bytes.size();
}

}  // namespace

double Distance(double actual, double expected) {
  const double d = std::abs(actual - expected);
  return std::isnan(d) ? INFINITY : d;
}

double UlpDistance(float actual, float expected, double floor) {
  if (actual == expected) return 0;
  if (!std::isfinite(actual) || !std::isfinite(expected)) return INFINITY;
  const float scale = std::max({std::abs(expected), float(floor), std::numeric_limits<float>::min()});
  const double ulp = std::ldexp(1.0, std::ilogb(scale) - 23);
  return std::abs(double(actual) - double(expected)) / ulp;
}

Outcome Measure(const Image& a, const Image& b, double limit) {
  Outcome o{.pixels = uint64_t(a.width) * a.height, .sameShape = SameShape(a, b)};
  if (!o.sameShape) return o;
  for (uint32_t y = 0; y < a.height; ++y)
    for (uint32_t x = 0; x < a.width; ++x) {
      const size_t at = (size_t(y) * a.width + x) * a.texelBytes;
      if (std::equal(&a.bytes[at], &a.bytes[at] + a.texelBytes, &b.bytes[at])) continue;
      const double distance = TexelDistance(&a.bytes[at], &b.bytes[at], a.texelBytes, a.component);
      ++o.differing;
      o.worst = std::max(o.worst, distance);
      if (distance <= limit && limit > 0) continue;  // other bytes that mean the same are a difference, too
      if (o.beyond++ == 0) o.x = x, o.y = y;
    }
  return o;
}

testing::AssertionResult Report(const Outcome& outcome, const Tolerance& tolerance, const Image& result,
                                const Image& reference, const std::string& firstWrong) {
  TheRecorder().Measured(tolerance, outcome.worst, outcome.Share());
  if (TheRecorder().Active())
    TheRecorder().Add({outcome, tolerance.name, tolerance.unit, tolerance.limit, tolerance.pixels,
                       outcome.Ok(tolerance), result, reference});
  if (outcome.Ok(tolerance)) return testing::AssertionSuccess();
  auto failure = testing::AssertionFailure();
  failure << outcome.beyond << " of " << outcome.pixels << " pixels are wrong";
  if (outcome.Share() > tolerance.differing)
    failure << ", " << outcome.differing << " differ (allowed: " << tolerance.differing * 100 << " %)";
  if (tolerance.limit > 0) failure << " (by up to " << outcome.worst << " " << ToString(tolerance.unit) << ")";
  return failure << ":" << firstWrong;
}

testing::AssertionResult SameImage(const Image& result, const Image& reference, const Tolerance& tolerance) {
  if (!SameShape(result, reference))
    return testing::AssertionFailure() << "pictures of different shape: " << result.width << " x " << result.height
                                       << " x " << result.texelBytes << " and " << reference.width << " x "
                                       << reference.height << " x " << reference.texelBytes;
  if (TheRecorder().ComparesBackends() && tolerance.limit == 0) return TheRecorder().Backends(result, reference);
  const Outcome outcome = Measure(result, reference, tolerance.limit);
  std::ostringstream first;
  if (outcome.beyond > 0) {
    const size_t at = (size_t(outcome.y) * result.width + outcome.x) * result.texelBytes;
    first << " the first at " << outcome.x << ", " << outcome.y << ":";
    for (uint32_t i = 0; i < result.texelBytes; ++i)
      first << ' ' << +result.bytes[at + i] << '/' << +reference.bytes[at + i];
  }
  return Report(outcome, tolerance, result, reference, first.str());
}

testing::AssertionResult Agrees(double actual, double expected, const Tolerance& tolerance) {
  const double distance = tolerance.unit == Unit::Ulp ? UlpDistance(float(actual), float(expected), tolerance.floor)
                                                      : Distance(actual, expected);
  TheRecorder().Measured(tolerance, distance);
  if (distance <= tolerance.limit) return testing::AssertionSuccess();
  return testing::AssertionFailure() << actual << " is " << distance << " " << ToString(tolerance.unit) << " from "
                                     << expected << ", allowed: " << tolerance.limit << " (" << tolerance.name << ")";
}

}  // namespace conformance
