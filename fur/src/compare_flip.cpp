// LDR-FLIP. Section numbers are those of Andersson, Nilsson, Akenine-Moeller, Oskarsson, Astrom, Fairchild, "FLIP: A
// Difference Evaluator for Alternating Images", Proc. ACM Comput. Graph. Interact. Tech. (HPG) 3(2), 2020.
#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <numbers>

#include "compare_internal.h"

namespace fur {
namespace {

constexpr double kPi = std::numbers::pi;

// sRGB (IEC 61966-2-1): linear rgb to XYZ, from the chromaticities of its primaries and of D65; glm's columns.
glm::dmat3 RgbToXyz() {
  const auto column = [](double x, double y) { return glm::dvec3(x / y, 1, (1 - x - y) / y); };
  const glm::dmat3 primaries(column(0.64, 0.33), column(0.30, 0.60), column(0.15, 0.06));
  const glm::dvec3 scale = glm::inverse(primaries) * column(0.3127, 0.3290);
  return {primaries[0] * scale.r, primaries[1] * scale.g, primaries[2] * scale.b};
}

struct ColorSpace {
  glm::mat3 toXyz = glm::mat3(RgbToXyz()), toRgb = glm::mat3(glm::inverse(RgbToXyz()));
  glm::vec3 white = glm::vec3(RgbToXyz() * glm::dvec3(1));
};

// The opponent space YCxCz of section 4.1: linear in XYZ, so that filtering in it is filtering light.
glm::vec3 ToOpponent(const glm::vec3& rgb, const ColorSpace& space) {
  const glm::vec3 t = space.toXyz * rgb / space.white;
  return {116 * t.y - 16, 500 * (t.x - t.y), 200 * (t.y - t.z)};
}

glm::vec3 FromOpponent(const glm::vec3& o, const ColorSpace& space) {
  const float y = (o.x + 16) / 116;
  return space.toRgb * (glm::vec3(y + o.y / 500, y, y - o.z / 200) * space.white);
}

// CIE 1976 L*a*b*, with the Hunt effect: chroma counts less in the dark (section 4.1, "Hunt").
glm::vec3 ToHuntLab(const glm::vec3& rgb, const ColorSpace& space) {
  constexpr float kDelta = 6.0f / 29;
  const auto f = [](float t) {
    return t > kDelta * kDelta * kDelta ? std::cbrt(t) : t / (3 * kDelta * kDelta) + 4.0f / 29;
  };
  const glm::vec3 t = space.toXyz * rgb / space.white;
  const float x = f(t.x), y = f(t.y), z = f(t.z), lightness = 116 * y - 16;
  return {lightness, 0.01f * lightness * 500 * (x - y), 0.01f * lightness * 200 * (y - z)};
}

// City blocks in lightness, Euclid in chroma (section 4.1, "HyAB").
float HyAb(const glm::vec3& a, const glm::vec3& b) {
  const float dy = a.y - b.y, dz = a.z - b.z;
  return std::abs(a.x - b.x) + std::sqrt(dy * dy + dz * dz);
}

// Section 4.1: errors are raised to q_c; the part below p_c c_max is stretched to 0..p_t.
constexpr float kQc = 0.7f, kPc = 0.4f, kPt = 0.95f;

float StretchColorError(float error, float largest) {
  const float limit = kPc * largest;
  if (error < limit) return kPt / limit * error;
  return kPt + (error - limit) / (largest - limit) * (1 - kPt);
}

// A contrast sensitivity function in space: a1 sqrt(pi/b1) exp(-pi^2 x^2/b1) + the same with a2, b2; x in degrees
// (section 4.1, table 1).
struct Sensitivity {
  double a1, b1, a2, b2;
};
constexpr Sensitivity kAchromatic{1, 0.0047, 0, 1e-5}, kRedGreen{1, 0.0053, 0, 1e-5};
constexpr Sensitivity kBlueYellow{34.1, 0.04, 13.5, 0.025};
constexpr double kWidestB = 0.04;

// exp(-pi^2 x^2/b), of sum 1; `sum` is what it was.
Kernel SensitivityGaussian(double b, double pixelsPerDegree, double* sum) {
  const int radius = int(std::ceil(3 * std::sqrt(kWidestB / (2 * kPi * kPi)) * pixelsPerDegree));
  std::vector<double> weights;
  *sum = 0;
  for (int i = -radius; i <= radius; ++i) {
    const double x = i / pixelsPerDegree;
    weights.push_back(std::exp(-kPi * kPi * x * x / b));
    *sum += weights.back();
  }
  Kernel kernel;
  for (const double w : weights) kernel.push_back(float(w / *sum));
  return kernel;
}

// Both Gaussians are separable, their sum is not: each is filtered by itself.
Plane FilterBySensitivity(const Plane& in, const Sensitivity& s, double pixelsPerDegree) {
  double sum1 = 0, sum2 = 0;
  const Kernel first = SensitivityGaussian(s.b1, pixelsPerDegree, &sum1);
  Plane out = FilterColumns(FilterRows(in, first), first);
  if (s.a2 == 0) return out;
  const Kernel second = SensitivityGaussian(s.b2, pixelsPerDegree, &sum2);
  const Plane other = FilterColumns(FilterRows(in, second), second);
  const double w1 = s.a1 * std::sqrt(kPi / s.b1) * sum1 * sum1, w2 = s.a2 * std::sqrt(kPi / s.b2) * sum2 * sum2;
  const float share1 = float(w1 / (w1 + w2)), share2 = float(w2 / (w1 + w2));
  for (size_t i = 0; i < out.values.size(); ++i) out.values[i] = share1 * out.values[i] + share2 * other.values[i];
  return out;
}

// Y, Cx and Cz of a picture.
std::array<Plane, 3> OpponentPlanes(const Rgb& in, const ColorSpace& space) {
  std::array<Plane, 3> planes;
  for (Plane& p : planes) p = {in.width, in.height, std::vector<float>(in.pixels.size())};
  for (size_t i = 0; i < in.pixels.size(); ++i) {
    const glm::vec3 o = ToOpponent(in.pixels[i], space);
    for (int c = 0; c < 3; ++c) planes[size_t(c)].values[i] = o[c];
  }
  return planes;
}

// What the eye makes of the colours at this distance, in Lab (section 4.1).
std::vector<glm::vec3> SeenColors(const std::array<Plane, 3>& opponent, const ColorSpace& space,
                                  double pixelsPerDegree) {
  const Plane y = FilterBySensitivity(opponent[0], kAchromatic, pixelsPerDegree);
  const Plane cx = FilterBySensitivity(opponent[1], kRedGreen, pixelsPerDegree);
  const Plane cz = FilterBySensitivity(opponent[2], kBlueYellow, pixelsPerDegree);
  std::vector<glm::vec3> lab(y.values.size());
  for (size_t i = 0; i < lab.size(); ++i) {
    const glm::vec3 rgb = FromOpponent({y.values[i], cx.values[i], cz.values[i]}, space);
    lab[i] = ToHuntLab(glm::clamp(rgb, 0.0f, 1.0f), space);
  }
  return lab;
}

// Scales the positive weights to the sum 1 and the negative ones to -1 (section 4.2).
Kernel Balance(const std::vector<double>& weights) {
  double positive = 0, negative = 0;
  for (const double w : weights) (w > 0 ? positive : negative) += w;
  Kernel kernel;
  for (const double w : weights) kernel.push_back(float(w > 0 ? w / positive : negative < 0 ? w / -negative : 0));
  return kernel;
}

// The strength of edges and of points: the length of the gradient by first and by second derivatives of a Gaussian of
// sigma w ppd / 2, w = 0.082 degrees (section 4.2).
struct Features {
  Plane edges, points;
};

Plane Length(const Plane& x, const Plane& y) {
  Plane out{x.width, x.height, std::vector<float>(x.values.size())};
  for (size_t i = 0; i < out.values.size(); ++i)
    out.values[i] = std::sqrt(x.values[i] * x.values[i] + y.values[i] * y.values[i]);
  return out;
}

Features FindFeatures(const Plane& opponentY, double pixelsPerDegree) {
  const double sigma = 0.5 * 0.082 * pixelsPerDegree;
  const int radius = int(std::ceil(3 * sigma));
  std::vector<double> g, g1, g2;
  for (int i = -radius; i <= radius; ++i) {
    const double x = i / sigma;
    g.push_back(std::exp(-x * x / 2));
    g1.push_back(-x * g.back());
    g2.push_back((x * x - 1) * g.back());
  }
  const Kernel smooth = Balance(g), edge = Balance(g1), point = Balance(g2);
  Plane y = opponentY;
  for (float& v : y.values) v = (v + 16) / 116;
  const Plane smoothRows = FilterRows(y, smooth);
  return {Length(FilterColumns(FilterRows(y, edge), smooth), FilterColumns(smoothRows, edge)),
          Length(FilterColumns(FilterRows(y, point), smooth), FilterColumns(smoothRows, point))};
}

}  // namespace

Plane FlipMap(const Rgb& reference, const Rgb& test, double pixelsPerDegree) {
  const ColorSpace space;
  const float largest = std::pow(HyAb(ToHuntLab({0, 1, 0}, space), ToHuntLab({0, 0, 1}, space)), kQc);
  const std::array<Plane, 3> a = OpponentPlanes(reference, space), b = OpponentPlanes(test, space);
  const std::vector<glm::vec3> labA = SeenColors(a, space, pixelsPerDegree);
  const std::vector<glm::vec3> labB = SeenColors(b, space, pixelsPerDegree);
  const Features fa = FindFeatures(a[0], pixelsPerDegree), fb = FindFeatures(b[0], pixelsPerDegree);
  Plane out{reference.width, reference.height, std::vector<float>(labA.size())};
  for (size_t i = 0; i < labA.size(); ++i) {
    const float color = StretchColorError(std::pow(HyAb(labA[i], labB[i]), kQc), largest);
    const float edges = std::abs(fa.edges.values[i] - fb.edges.values[i]);
    const float points = std::abs(fa.points.values[i] - fb.points.values[i]);
    // (max / sqrt 2)^q_f, q_f = 0.5; then section 4.3: differing features make a difference in colour weigh more.
    const float features = std::sqrt(std::max(edges, points) * float(1 / std::numbers::sqrt2));
    out.values[i] = std::clamp(std::pow(color, 1 - std::min(features, 1.0f)), 0.0f, 1.0f);
  }
  return out;
}

}  // namespace fur
