#include "tolerances.h"

#include <cmath>
#include <stdexcept>

#include "names.h"
#include "recorder.h"

namespace conformance {
namespace {

constexpr const char* kIndependent = "vulkan:swiftshader";  // rasterisers, samplers and blenders of another's making
constexpr const char* kNvidia = "*:nvidia*";                // measured on an H200, driver 580.159.04

// Limits are no wider than what was measured (Slack), and no wider than ceilings.txt.
constexpr Tolerance kTolerances[] = {
    {"resolve_average", "msaa.*", kNvidia, Unit::Lsb, 1, 0, 0, 1, "NVIDIA rounds the average of samples down"},
    {"srgb_decoding", "srgb.*", kNvidia, Unit::Value, 0.45, 0, 0, 0.4297,
     "in steps of the encoded byte: NVIDIA decodes sRGB by a table of half floats; Direct3D allows 0.5"},
    {"srgb_decoding_of_formats", "format.*", kNvidia, Unit::Value, 0.0029, 0, 0, 0.0028484,
     "NVIDIA decodes sRGB by a table of half floats"},
    {"mip_average", "mips.*,texture.*,slice.gen_mips*", kNvidia, Unit::Lsb, 2, 0, 0, 2,
     "one texel of 1,024: the weights of the linear filter, and decoding of sRGB"},
    {"blend_rounding", "blend.*", "*", Unit::Lsb, 1, 0, 0, 1,
     "drivers blend 8-bit targets in 8-bit integers and round each product"},
    {"repeated_blend", "binding.ping_pong", "*", Unit::Lsb, 3, 0, 0, 3,
     "six blends into 8 bits: 0.1 is 25.5 of 255, and each rounds its half in one direction"},
    {"mip_average", "mips.*,texture.*,slice.gen_mips*", "*", Unit::Lsb, 1, 0, 0, 1,
     "mips are made by the linear filter, whose weights have 8 bits"},
    {"filter_weights", "sampler.*", "*", Unit::Lsb, 1, 0, 0, 1, "the linear filter's weights have 8 bits"},
    {"srgb_to_linear", "srgb.*", "*", Unit::Lsb, 1, 0, 0, 1, "llvmpipe decodes sRGB by a polynomial"},
    {"linear_to_srgb", "srgb.*,msaa.*", "*", Unit::Lsb, 1, 0, 0, 1, "llvmpipe encodes sRGB by a polynomial"},
    {"srgb_decoding", "srgb.*", "*", Unit::Value, 0.345, 0, 0, 0.3425,
     "in steps of the encoded byte: llvmpipe decodes sRGB by a polynomial; Direct3D allows 0.5"},
    {"srgb_decoding_of_formats", "format.*", "*", Unit::Value, 0.0012, 0, 0, 0.0011943,
     "llvmpipe decodes sRGB by a polynomial"},
    {"unorm_to_float", "srgb.*,format.*", "*", Unit::Ulp, 1, 0, 0, 1,
     "a byte is multiplied by 1/255, not divided by 255"},
    {"resolve_average", "msaa.*", kIndependent, Unit::Lsb, 1, 0, 0, 1,
     "SwiftShader rounds the average of samples down"},
    {"alpha_to_coverage", "msaa.*", "*", Unit::Value, 0.251, 0, 0, 0.25098,
     "four samples: coverage has steps of a quarter"},
    {"format_step", "format.*", "*", Unit::Value, 0.0031, 0, 0, 0.003067,
     "a value between two steps of a normalised format; 4 bits of the coarsest"},
    {"format_blend", "format.*", "*", Unit::Value, 0.003, 0, 0, 0.0029422, "three quarters of a step of 8 bits"},
    {"two_bit_blend", "format.*", "*", Unit::Value, 0.0834, 0, 0, 0.0833333, "alpha of RGB10A2 has steps of a third"},
    {"format_resolve", "format.*", "*", Unit::Value, 0.001, 0, 0, 0.00098041, "0.25 is between two steps of 8 bits"},
    {"behind_a_geometry_shader", "fur.gs_*", "*", Unit::Lsb, 1, 0, 0, 1,
     "Mesa brings positions to the viewport in other arithmetic behind a geometry shader than behind a vertex shader: an "
     "edge moves by up to a step of the rasteriser's grid, and colours are interpolated to other last bits",
     0.00021, 0.00020833},
    {"format_filter", "format.*", "*", Unit::Value, 0.002, 0, 0, 0.00196082, "0.5 is between two steps of 8 bits"},
};

constexpr ParityLimit kNoDifference{"*", "*", 0, 0, 0, 0, 0, 0, ""};
constexpr double kNotCompared = ParityLimit::kNotCompared;
constexpr ParityLimit kParityLimits[] = {
    {"format.resolve_and_mips_work_where_they_are_offered,format.unordered_access_formats_are_written", "*", 0, 1,
     kNotCompared, 0, 1, 1, "each backend tries the formats that its driver offers, and these differ"},
    // NVIDIA's two compilers: a product and a sum become one operation in one of them.
    {"fur.supersampled_floats", kNvidia, 13087, 0.1487, 0, 13087, 0.1487, 0,
     "ULP, relative to what is often dark: products and sums are rounded once or twice"},
    {"fur.*_is_caught", kNvidia, 0, 0, 0, 0, 0, 0, "planted differences: none is allowed"},
    {"fur.*", kNvidia, 1, 0.000157, 0, 1, 0.000157, 0, "products and sums are rounded once or twice"},
    {"slice.gen_mips_of_a_volume", kNvidia, 1, 0.0963, 0, 1, 0.0963, 0, "the blits of the two drivers round otherwise"},
    {"format.targets_take_draws_and_clears", kNvidia, 1, 0.0295, 0, 1, 0.0295, 0,
     "clears of the two drivers round otherwise"},
    // Independent rasterisers.
    {"blend.factor_op/*", kIndependent, 1, 0.6875, 0, 1, 0.6875, 0,
     "SwiftShader blends in floats, llvmpipe in 8-bit integers"},
    {"format.texels_are_read_as_they_are_written,srgb.sampled_texels_are_linear", kIndependent, 513811, 0.9961, 0,
     513811, 0.9961, 0, "ULP: SwiftShader decodes sRGB exactly, llvmpipe by a polynomial"},
    {"format.targets_take_draws_and_clears", kIndependent, 1, 0.0589, 0, 1, 0.0589, 0,
     "SwiftShader encodes sRGB exactly, llvmpipe by a polynomial"},
    {"format.linear_formats_are_filtered", kIndependent, 32897, 0.2858, 0, 32897, 0.2858, 0,
     "ULP: half of 255 is rounded to the other side"},
    {"mips.gen_mips_array*,slice.gen_mips_of_*,parity.gen_mips_array/*", kIndependent, 4, 1, 0, 4, 1, 0,
     "the linear filter rounds its weights and sums otherwise"},
    {"srgb.*,msaa.srgb_resolve_is_linear", kIndependent, 1, 1, 0, 1, 1, 0,
     "SwiftShader encodes and decodes sRGB exactly, llvmpipe by polynomials"},
    {"msaa.a2c_coverage_bounds", kIndependent, 64, 0.6524, 0, 64, 0.6524, 0,
     "a sample more or less: where coverage steps is left to the driver"},
    {"msaa.sample_mask", kIndependent, 1, 0.125, 0, 1, 0.125, 0, "SwiftShader rounds the average of samples down"},
    {"sampler.linear_filter/*,sampler.one_texture_two_samplers", kIndependent, 1, 0.477, 0, 1, 0.477, 0,
     "the linear filter rounds its weights and sums otherwise"},
    {"sampler.aniso_monotone", kIndependent, 78, 0.8, 0, 78, 0.8, 0,
     "which texels an anisotropic filter takes is left to the driver"},
    {"parity.same_bytes/pattern", kIndependent, 1, 0.0706, 0, 1, 0.0706, 0,
     "transcendental functions are approximated otherwise"},
    {"parity.same_bytes/pattern_16f", kIndependent, 12, 0.8429, 0, 12, 0.8429, 0,
     "ULP of halves: transcendental functions are approximated otherwise"},
    {"parity.same_bytes/pattern_32f", kIndependent, 196608, 0.7014, 0, 196608, 0.7014, 0,
     "ULP, near zero: transcendental functions are approximated otherwise"},
    {"parity.same_bytes/trilinear", kIndependent, 2, 0.9273, 0, 2, 0.9273, 0,
     "the linear filter rounds its weights and sums otherwise"},
    {"parity.same_bytes/srgb_*", kIndependent, 1, 0.3704, 0, 1, 0.3704, 0,
     "SwiftShader decodes sRGB exactly; filter weights"},
    {"parity.same_bytes/aniso", kIndependent, 18, 1, 0, 18, 1, 0,
     "which texels an anisotropic filter takes is left to the driver"},
    {"parity.same_bytes/triangles*", kIndependent, 1, 0.2642, 0.0429, 1, 0.2642, 0.0429,
     "edges of triangles with other sub-pixel bits, and interpolation rounds otherwise"},
    {"parity.same_bytes/blended_16f", kIndependent, 4, 0.9965, 0.0363, 4, 0.9965, 0.0363,
     "ULP of halves: edges, and sums of many layers round otherwise"},
    {"parity.same_bytes/blended*", kIndependent, 4, 0.7989, 0.0166, 4, 0.7989, 0.0166,
     "edges, and each blend rounds otherwise"},
    {"parity.same_bytes/alpha_to_coverage_4x", kIndependent, 64, 0.8099, 0.0122, 64, 0.8099, 0.0122,
     "a sample more or less: where coverage steps is left to the driver"},
    {"clear.reaches_the_whole_view_whatever_the_state,clear.leaves_the_state_as_it_was,clear.stencil_is_read_back",
     kIndependent, 0, 1, kNotCompared, 0, 1, 1, "SwiftShader has no D24_UNorm_S8_UInt: the cases read other formats"},
    {"fur.supersampled_floats", kIndependent, 65536, 0.2043, 0.1228, 65536, 0.2043, 0.1228,
     "ULP, relative to what is often dark: edges with other sub-pixel bits, 16 layers; interpolation rounds otherwise"},
    {"fur.*_is_caught", kIndependent, 0, 0, 0, 0, 0, 0, "planted differences: none is allowed"},
    {"fur.bare_skin_with_four_samples", kIndependent, 8, 0.3703, 0.0087, 8, 0.3703, 0.0087,
     "edges of triangles with other sub-pixel bits, 16 layers of them; interpolation and each blend round otherwise"},
    {"fur.five_animals*", kIndependent, 8, 0.3997, 0.0082, 8, 0.3997, 0.0082,
     "edges of triangles with other sub-pixel bits, 16 layers of them; interpolation and each blend round otherwise"},
    {"fur.*", kIndependent, 8, 0.1644, 0.007, 8, 0.1644, 0.007,
     "edges of triangles with other sub-pixel bits, 16 layers of them; interpolation and each blend round otherwise"},
    {"zero.*_in_every_stage", kIndependent, 0, 1, kNotCompared, 0, 1, 1,
     "SwiftShader has no geometry shaders: the cases read fewer stages"},
};

}  // namespace

const char* ToString(Unit unit) { return unit == Unit::Lsb ? "LSB" : unit == Unit::Ulp ? "ULP" : "of the value"; }

std::span<const Tolerance> Tolerances() { return kTolerances; }
std::span<const ParityLimit> ParityLimits() { return kParityLimits; }

const Tolerance& Within(const std::string& name) {
  const Recorder& recorder = TheRecorder();
  bool known = false;
  for (const Tolerance& t : kTolerances) {
    if (t.name != name) continue;
    known = true;
    if (recorder.Active() && !MatchesGlob(t.cases, recorder.Running().Base())) continue;
    if (!recorder.Active() || MatchesGlob(t.drivers, recorder.Driver())) return t;
  }
  if (known && !recorder.Active()) return kExact;
  for (const Tolerance& t : kTolerances)
    if (t.name == name && MatchesGlob(t.cases, recorder.Running().Base())) return kExact;  // but for another driver
  throw std::runtime_error("tests/conformance/tolerances.cpp has no tolerance '" + name + "' for " +
                           recorder.Running().Full());
}

const ParityLimit& ParityLimitOf(const std::string& name, const std::string& driver) {
  for (const ParityLimit& limit : kParityLimits)
    if (MatchesGlob(limit.cases, name) && MatchesGlob(limit.drivers, driver)) return limit;
  return kNoDifference;
}

std::string Slack(const Tolerance& t, double measured, double differing) {
  const double least = t.unit == Unit::Value ? 1.05 * measured : std::ceil(measured);
  const auto tooWide = [&](double limit, const char* unit, double seen) {
    return std::string("tolerance ") + t.name + " on " + t.drivers + " is wider than it has to be: " +
           std::to_string(limit) + " " + unit + ", measured " + std::to_string(seen) +
           "; tests/conformance/tolerances.cpp";
  };
  if (t.limit > least) return tooWide(t.limit, ToString(t.unit), measured);
  if (t.differing > 1.05 * differing) return tooWide(t.differing, "of the pixels", differing);
  return "";
}

}  // namespace conformance
