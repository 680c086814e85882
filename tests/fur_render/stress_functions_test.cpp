// The shaders' functions over a million arguments, random and adversarial, on each backend against double precision. Prints
// the error of each in units in the last place of the largest component of the exact result, and holds it below a bound.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <functional>
#include <numbers>
#include <random>

#include "fur_render_test_shaders/shaders.h"
#include "gpu_constants.h"
#include "support.h"

namespace fur::test {
namespace {

using glm::dvec3;
using glm::dvec4;

constexpr uint32_t kArguments = 1 << 20, kChunk = 1 << 17;

struct Arguments {
  glm::vec4 a, b, c;
};

// Constants that the functions read. Powers of two and short fractions: a float holds them exactly.
FrameConstants Frame() {
  FrameConstants f{};
  f.lightDirection = glm::vec4(0.36f, -0.8f, 0.48f, 0);  // unit but for its last digits
  f.lightDiffuse = glm::vec4(0.875f, 0.75f, 0.5f, 0);
  f.lightAmbient = glm::vec4(0.125f, 0.25f, 0.1875f, 0);
  f.lightSpecular = glm::vec4(0.375f, 0.25f, 0.5f, 0);
  return f;
}
MaterialConstants Material() {
  MaterialConstants m{};
  m.furLight = glm::vec4(0.25f, 30, 0.375f, 0);
  m.fin = glm::vec4(0.25f, 0.875f, 0, 0);
  m.groom = glm::vec4(1, 0, 0.75f, 1.5f);
  m.rootColor = glm::vec4(0.25f, 0.375f, 0.5f, 0);
  m.tipColor = glm::vec4(1, 1.125f, 0.75f, 0);
  return m;
}
ObjectConstants Object() {
  ObjectConstants o{};
  o.comb = glm::vec4(0.25f, -0.5f, 0.125f, 2);
  o.gravity = glm::vec4(0, -0.5f, 0.25f, 0);
  o.wind = glm::vec4(0.5f, 0.25f, -0.125f, 0);
  o.windWave = glm::vec4(0.25f, 0.125f, -0.5f, 0.75f);
  return o;
}

// ------------------------------------------------------------------------------------------- the same in double
dvec3 XYZ(const glm::vec4& v) { return dvec3(v); }
dvec3 UnitOr(const dvec3& v, const dvec3& fallback) {
  const double d = glm::dot(v, v);
  return d > 1e-36 ? v / std::sqrt(d) : fallback;
}
double Saturate(double x) { return std::clamp(x, 0.0, 1.0); }

dvec4 Unit(const Arguments& x) { return dvec4(UnitOr(XYZ(x.a), {0, 0, 1}), 0); }
dvec4 Products(const Arguments& x) { return dvec4(glm::cross(XYZ(x.a), XYZ(x.b)), glm::dot(XYZ(x.a), XYZ(x.b))); }
dvec4 Unpack(const Arguments& x) {
  const dvec3 t = XYZ(x.a) * 2.0 - 1.0;
  return dvec4(glm::dot(t, t) < 1.0 / 4096 ? dvec3(0, 0, 1) : glm::normalize(t), 0);
}
dvec4 Slab(const Arguments& x) { return {1 - std::pow(1 - double(x.a.x), double(x.a.y)), 0, 0, 0}; }
double SineOfTurns(double turns) { return std::sin(2 * std::numbers::pi * (turns - std::floor(turns))); }
dvec4 Sine(const Arguments& x) { return {SineOfTurns(double(x.a.x)), 0, 0, 0}; }
dvec4 Encode(const Arguments& x) {
  const double l = double(x.a.x);
  return {l <= 0.0031308 ? l * 12.92 : 1.055 * std::pow(l, 1 / 2.4) - 0.055, 0, 0, 0};
}
dvec4 Light(const Arguments& x) {
  const FrameConstants f = Frame();
  const MaterialConstants m = Material();
  const dvec3 strand = XYZ(x.a), normal = XYZ(x.b), albedo = XYZ(x.c), l = -XYZ(f.lightDirection);
  const dvec3 e = -UnitOr({double(x.a.w), double(x.b.w), -1.0}, {0, 0, 1});
  const double tl = glm::dot(strand, l), te = glm::dot(strand, e);
  const double sinTl = std::sqrt(std::max(0.0, 1 - tl * tl)), sinTe = std::sqrt(std::max(0.0, 1 - te * te));
  const double facing = Saturate((glm::dot(normal, l) + 0.5) / 1.5);
  const double lobe = std::pow(std::max(0.0, sinTl * sinTe - tl * te), double(m.furLight.y)) * facing;
  const double ramp = glm::mix(double(m.furLight.x), 1.0, double(x.c.w));
  const dvec3 direct = XYZ(f.lightDiffuse) * albedo * ((sinTl + std::numbers::pi / 4) / 2 * facing) +
                       XYZ(f.lightSpecular) * (lobe * double(m.furLight.z));
  return dvec4((XYZ(f.lightAmbient) * albedo + direct) * ramp, 0);
}
dvec4 Albedo(const Arguments& x) {
  const MaterialConstants m = Material();
  const dvec3 base = XYZ(x.a) * double(m.groom.z) + (1 - double(m.groom.z));
  const dvec3 albedo = base * glm::mix(XYZ(m.rootColor), XYZ(m.tipColor), double(x.a.w)) * XYZ(x.b);
  return dvec4(glm::pow(glm::clamp(albedo, dvec3(1e-6), dvec3(1)), dvec3(double(m.groom.w))), 0);
}
dvec4 Tip(const Arguments& x) {
  const ObjectConstants o = Object();
  const dvec3 gravity = XYZ(o.gravity), direction = XYZ(x.b);
  const double turns = glm::dot(XYZ(o.windWave), XYZ(x.a)) - double(o.windWave.w);
  const double gust = (0.5 + 0.5 * SineOfTurns(turns)) * (0.625 + 0.375 * SineOfTurns(turns / 4));
  return dvec4(XYZ(o.comb) + XYZ(o.wind) * gust + gravity - direction * glm::dot(gravity, direction), 0);
}
dvec4 Fade(const Arguments& x) {
  const dvec3 p0 = XYZ(x.a), p1 = XYZ(x.b), p2 = XYZ(x.c), p3(double(x.a.w), double(x.b.w), double(x.c.w));
  const dvec3 e = -UnitOr(p1 + p2, {0, 0, 1});
  const double n1 = glm::dot(e, UnitOr(glm::cross(p2 - p1, p3 - p1), dvec3(0)));
  const double n2 = glm::dot(e, UnitOr(glm::cross(p1 - p2, p0 - p2), dvec3(0)));
  const double exact = n1 * n2 < 0 ? 1 : 0;
  return {Saturate(std::max(exact, 1 - std::min(std::abs(n1), std::abs(n2)) / 0.25)), 0, 0, 0};
}

// ------------------------------------------------------------------------------------------------------ arguments
class Maker {
 public:
  float Between(double low, double high) {
    return float(std::uniform_real_distribution<double>(low, high)(random_));
  }
  // Any sign, sizes from 2^-bits to 2^bits evenly.
  float Any(double bits) { return std::ldexp(Between(0.5, 1), int(Between(-bits, bits))) * (random_() & 1 ? 1 : -1); }
  float Pick(std::initializer_list<float> values) { return values.begin()[random_() % values.size()]; }
  bool Rarely() { return random_() % 8 == 0; }
  glm::vec3 Direction() {
    const glm::dvec3 axes[] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {-0.36, 0.8, -0.48}, {0.36, -0.8, 0.48}};
    if (Rarely()) return glm::vec3(axes[random_() % 5]);
    return glm::vec3(glm::normalize(dvec3(normal_(random_), normal_(random_), normal_(random_))));
  }
  glm::vec3 Vector(double bits) { return {Any(bits), Any(bits), Any(bits)}; }

 private:
  std::mt19937_64 random_{20260101};
  std::normal_distribution<double> normal_;
};

struct Function {
  const char* name;
  std::function<dvec4(const Arguments&)> exact;
  std::function<Arguments(Maker*)> make;
  // Units in the last place of the largest component of the exact result, but of `floor` at least, where what is summed is
  // larger than what remains.
  double bound;
  double floor;
};

Arguments Unit4(const glm::vec3& v, float w) { return {glm::vec4(v, w), glm::vec4(0), glm::vec4(0)}; }

std::vector<Function> Functions() {
  return {
      {"UnitOr", Unit, [](Maker* m) { return Unit4(m->Rarely() ? glm::vec3(0) : m->Vector(40), 0); }, 4, 0},
      {"Cross3, Dot3", Products,
       [](Maker* m) { return Arguments{glm::vec4(m->Direction(), 0), glm::vec4(m->Direction(), 0), {}}; }, 2, 1},
      {"UnpackStrand", Unpack,
       [](Maker* m) {
         const auto byte = [m] { return float(int(m->Between(0, 256))) / 255; };
         return Unit4({byte(), byte(), m->Rarely() ? 0.5f : byte()}, 0);
       },
       4, 0},
      {"SlabOpacity", Slab,
       [](Maker* m) {
         const float a = m->Rarely() ? m->Pick({0, 1 / 255.0f, 0.5f, 0.998f, 0.999f}) : m->Between(0, 0.999);
         return Unit4({a, m->Rarely() ? m->Pick({0.01f, 1, 64}) : m->Between(0.01, 16), 0}, 0);
       },
       64, 1},  // an exponent of 64 multiplies the logarithm's error
      {"SineOfTurns", Sine,
       [](Maker* m) { return Unit4({m->Rarely() ? m->Pick({0, 0.25f, 0.5f, -0.75f}) : m->Between(-64, 64), 0, 0}, 0); },
       32, 1},  // a series of five terms
      {"Encode (sRGB)", Encode,
       [](Maker* m) { return Unit4({m->Rarely() ? m->Pick({0, 0.0031308f, 0.00313081f, 1}) : m->Between(0, 1), 0, 0}, 0); },
       4, 1},
      {"FurLight", Light,
       [](Maker* m) {
         const glm::vec3 albedo(m->Between(0, 1), m->Between(0, 1), m->Between(0, 1));
         return Arguments{glm::vec4(m->Direction(), m->Any(4)), glm::vec4(m->Direction(), m->Any(4)),
                          glm::vec4(albedo, m->Between(0, 1))};
       },
       32, 1},  // the highlight's exponent is 30
      {"GroomedAlbedo", Albedo,
       [](Maker* m) {
         const glm::vec3 base(m->Between(0, 1), m->Between(0, 1), m->Rarely() ? 0 : m->Between(0, 1));
         return Arguments{glm::vec4(base, m->Between(0, 1)), glm::vec4(m->Between(0, 2), m->Between(0, 2), 1, 0), {}};
       },
       4, 1},
      {"TipOffset", Tip,
       [](Maker* m) { return Arguments{glm::vec4(m->Vector(3), 0), glm::vec4(m->Direction(), 0), {}}; }, 16, 1},
      {"FinFade", Fade,
       [](Maker* m) {
         const auto corner = [m] { return m->Vector(2) + glm::vec3(0, 0, -8); };
         const glm::vec3 p0 = corner(), p1 = corner(), p2 = corner(), p3 = corner();
         return Arguments{glm::vec4(p0, p3.x), glm::vec4(p1, p3.y), glm::vec4(p2, p3.z)};
       },
       256, 1},  // faces of slivers, and the threshold divides by a quarter
  };
}

double Ulp(double value) {
  const auto f = float(std::abs(value));
  return double(std::nextafter(f, std::numeric_limits<float>::infinity())) - double(f);
}

struct Errors {
  double most = 0, sum = 0;
  uint64_t count = 0, notFinite = 0;
  Arguments worst{};
};

void Add(const Function& f, const Arguments& x, const glm::vec4& got, Errors* e) {
  const dvec4 exact = f.exact(x);
  const dvec4 size = glm::abs(exact), off = glm::abs(dvec4(got) - exact);
  const double largest = std::max({size.x, size.y, size.z, size.w, f.floor});
  const double error = std::max({off.x, off.y, off.z, off.w}) / Ulp(largest);
  if (!std::isfinite(error)) {
    ++e->notFinite;
    return;
  }
  if (error > e->most) e->worst = x;
  e->most = std::max(e->most, error);
  e->sum += error;
  ++e->count;
}

class FunctionTable {
 public:
  explicit FunctionTable(TestDevice* device) : device_(**device), context_(*device_.ImmediateContext()) {
    Ok(device_.CreateShader(test_shaders::functions_CSMain, &shader_));
    const auto constants = [&](const auto& value) {
      rhi::Ref<rhi::IBuffer> buffer;
      Ok(device_.CreateBuffer({.byteWidth = sizeof value, .bind = rhi::Bind::ConstantBuffer}, &value, &buffer));
      return buffer;
    };
    constants_ = {constants(Frame()), constants(Material()), constants(Object())};
  }

  Errors Measure(const Function& f, uint32_t index) {
    const DrawConstants draw{glm::vec4(float(index), 0, 0, 0)};
    rhi::Ref<rhi::IBuffer> drawBuffer;
    Ok(device_.CreateBuffer({.byteWidth = sizeof draw, .bind = rhi::Bind::ConstantBuffer}, &draw, &drawBuffer));
    rhi::IBuffer* const buffers[] = {constants_[0].get(), constants_[1].get(), constants_[2].get(), drawBuffer.get()};
    context_.SetConstantBuffers(0, 4, buffers);
    context_.CSSetShader(shader_.get());
    Maker maker;
    Errors errors;
    for (uint32_t done = 0; done < kArguments; done += kChunk) {
      std::vector<Arguments> arguments(kChunk);
      for (Arguments& x : arguments) x = f.make(&maker);
      const std::vector<glm::vec4> got = Run(arguments);
      for (uint32_t i = 0; i < kChunk; ++i) Add(f, arguments[i], got[i], &errors);
    }
    return errors;
  }

 private:
  static void Ok(rhi::Status status) { EXPECT_EQ(status, rhi::Status::Ok); }

  std::vector<glm::vec4> Run(const std::vector<Arguments>& arguments) {
    std::vector<glm::vec4> results(arguments.size(), glm::vec4(NAN));
    rhi::Ref<rhi::IBuffer> in, out;
    rhi::Ref<rhi::IShaderResourceView> read;
    rhi::Ref<rhi::IUnorderedAccessView> write;
    Ok(device_.CreateBuffer({.byteWidth = uint32_t(arguments.size() * sizeof(Arguments)), .bind = rhi::Bind::ShaderResource,
                             .structureStride = sizeof(Arguments)},
                            arguments.data(), &in));
    Ok(device_.CreateBuffer({.byteWidth = uint32_t(results.size() * sizeof(glm::vec4)),
                             .bind = rhi::Bind::ShaderResource | rhi::Bind::UnorderedAccess,
                             .structureStride = sizeof(glm::vec4)},
                            results.data(), &out));
    Ok(device_.CreateShaderResourceView(in.get(), nullptr, &read));
    Ok(device_.CreateUnorderedAccessView(out.get(), nullptr, &write));
    rhi::IShaderResourceView* source = read.get();
    rhi::IUnorderedAccessView* target = write.get();
    context_.CSSetShaderResources(8, 1, &source);
    context_.CSSetUnorderedAccessViews(0, 1, &target);
    context_.Dispatch(uint32_t(arguments.size() / 64), 1, 1);
    source = nullptr;
    target = nullptr;
    context_.CSSetShaderResources(8, 1, &source);
    context_.CSSetUnorderedAccessViews(0, 1, &target);
    Ok(device_.ReadBack(out.get(), 0, uint32_t(results.size() * sizeof(glm::vec4)), results.data()));
    return results;
  }

  rhi::IDevice& device_;
  rhi::IContext& context_;
  rhi::Ref<rhi::IShader> shader_;
  std::array<rhi::Ref<rhi::IBuffer>, 3> constants_;
};

class StressFunctions : public OnEachBackend {};
INSTANTIATE_TEST_SUITE_P(Backends, StressFunctions, testing::ValuesIn(Backends()), BackendName);

TEST_P(StressFunctions, ErrorInUlp) {
  if (!(*device_)->GetCaps().compute) GTEST_SKIP() << GetParam().name << " has no compute shaders";
  FunctionTable table(device_.get());
  std::printf("  %-16s %10s %10s  (ulp, %u arguments, %s)\n", "function", "mean", "largest", kArguments, GetParam().name);
  const std::vector<Function> functions = Functions();
  for (uint32_t i = 0; i < functions.size(); ++i) {
    const Function& f = functions[i];
    const Errors e = table.Measure(f, i);
    std::printf("  %-16s %10.3f %10.1f\n", f.name, e.sum / double(std::max<uint64_t>(e.count, 1)), e.most);
    EXPECT_EQ(e.notFinite, 0u) << f.name;
    EXPECT_LE(e.most, f.bound) << f.name << " at " << e.worst.a.x << " " << e.worst.a.y << " " << e.worst.a.z << " "
                               << e.worst.a.w << ", " << e.worst.b.x << " " << e.worst.b.y << " " << e.worst.b.z << " "
                               << e.worst.b.w << ", " << e.worst.c.x << " " << e.worst.c.y << " " << e.worst.c.z << " "
                               << e.worst.c.w;
  }
}

}  // namespace
}  // namespace fur::test
