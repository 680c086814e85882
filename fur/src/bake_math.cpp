#include "bake_math.h"

#include <cmath>

namespace fur {

// log2 by its atanh series on the mantissa in [1/sqrt 2, sqrt 2), 2^y by Taylor.
double Power(double x, double p) {
  if (p == 0) return 1;
  if (x <= 0) return 0;
  int exponent = 0;
  double m = std::frexp(x, &exponent);
  if (m < 0.70710678118654752) m *= 2, --exponent;
  const double z = (m - 1) / (m + 1), z2 = z * z;
  double series = 0;
  for (int k = 17; k >= 1; k -= 2) series = series * z2 + 1.0 / k;
  const double y = p * (exponent + series * z * 2 / 0.69314718055994531);
  if (y < -1000) return 0;
  const double whole = std::floor(y + 0.5), t = (y - whole) * 0.69314718055994531;
  double sum = 1;
  for (int k = 13; k >= 1; --k) sum = 1 + sum * t / k;
  return std::ldexp(sum, static_cast<int>(whole));
}

// Taylor on [-1/8, 1/8] turns, then quarters of a turn.
glm::dvec2 CosSinTurns(double turns) {
  const double quarters = std::floor(turns * 4 + 0.5);
  const double x = (turns - quarters / 4) * 6.2831853071795865, x2 = x * x;
  double c = 1, s = 1;
  for (int k = 16; k >= 2; k -= 2) c = 1 - c * x2 / (k * (k - 1));
  for (int k = 17; k >= 3; k -= 2) s = 1 - s * x2 / (k * (k - 1));
  s *= x;
  switch (static_cast<int>(quarters - 4 * std::floor(quarters / 4))) {
    case 0: return {c, s};
    case 1: return {-s, c};
    case 2: return {-c, -s};
    default: return {s, -c};
  }
}

double Nearest(double d) { return d - std::floor(d + 0.5); }
glm::dvec2 Nearest(glm::dvec2 d) { return {Nearest(d.x), Nearest(d.y)}; }

}  // namespace fur
