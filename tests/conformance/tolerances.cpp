#include "tolerances.h"

#include <cmath>
#include <limits>
#include <stdexcept>

#include "names.h"
#include "recorder.h"

namespace conformance {
namespace {

constexpr Tolerance kTolerances[] = {
    {"blend_rounding", "*", "*", Unit::Lsb, 99, 0, 0, 1, "?"},
    {"repeated_blend", "*", "*", Unit::Lsb, 99, 0, 0, 1, "?"},
    {"sum_of_unorms", "*", "*", Unit::Lsb, 99, 0, 0, 1, "?"},
    {"half_to_unorm", "*", "*", Unit::Lsb, 99, 0, 0, 1, "?"},
    {"mip_average", "*", "*", Unit::Lsb, 99, 0, 0, 1, "?"},
    {"srgb_to_linear", "*", "*", Unit::Lsb, 99, 0, 0, 1, "?"},
    {"linear_to_srgb", "*", "*", Unit::Lsb, 99, 0, 0, 1, "?"},
    {"resolve_average", "*", "*", Unit::Lsb, 99, 0, 0, 1, "?"},
    {"filter_weights", "*", "*", Unit::Lsb, 99, 0, 0, 1, "?"},
    {"block_decoding", "*", "*", Unit::Lsb, 99, 0, 0, 1, "?"},
    {"mip_weights", "*", "*", Unit::Lsb, 99, 0, 0, 1, "?"},
    {"depth_to_24_bits", "*", "*", Unit::Lsb, 99, 0, 0, 1, "?"},
    {"interpolation", "*", "*", Unit::Ulp, 9999, 0, 0, 1, "?"},
    {"depth_bias", "*", "*", Unit::Ulp, 9999, 0, 0, 1, "?"},
    {"unorm_to_float", "*", "*", Unit::Ulp, 9999, 0, 0, 1, "?"},
    {"srgb_decoding_of_formats", "*", "*", Unit::Value, 9, 0, 0, 1, "?"},
    {"srgb_decoding", "*", "*", Unit::Value, 9, 0, 0, 1, "?"},
    {"alpha_to_coverage", "*", "*", Unit::Value, 9, 0, 0, 1, "?"},
    {"format_step", "*", "*", Unit::Value, 9, 0, 0, 1, "?"},
    {"two_bit_blend", "*", "*", Unit::Value, 9, 0, 0, 1, "?"},
    {"format_blend", "*", "*", Unit::Value, 9, 0, 0, 1, "?"},
    {"format_resolve", "*", "*", Unit::Value, 9, 0, 0, 1, "?"},
    {"format_filter", "*", "*", Unit::Value, 9, 0, 0, 1, "?"},
};

constexpr double kAny = std::numeric_limits<double>::infinity();
constexpr ParityLimit kNoDifference{"*", "*", 0, 0, 0, 0, ""};
constexpr ParityLimit kParityLimits[] = {
    {"format.resolve_and_mips_work_where_they_are_offered", "*", kAny, 1, kAny, 1,
     "each backend tries the formats that its driver offers, and these differ"},
    {"format.unordered_access_formats_are_written", "*", kAny, 1, kAny, 1,
     "each backend tries the formats that its driver offers, and these differ"},
};

}  // namespace

const char* ToString(Unit unit) { return unit == Unit::Lsb ? "LSB" : unit == Unit::Ulp ? "ULP" : "of the value"; }

std::span<const Tolerance> Tolerances() { return kTolerances; }
std::span<const ParityLimit> ParityLimits() { return kParityLimits; }

const Tolerance& Within(const std::string& name) {
  for (const Tolerance& t : kTolerances)
    if (t.name == name && MatchesGlob(t.drivers, TheRecorder().Driver())) return t;
  throw std::runtime_error("tests/conformance/tolerances.cpp has no tolerance '" + name + "' for " +
                           TheRecorder().Driver());
}

const ParityLimit& ParityLimitOf(const std::string& name, const std::string& driver) {
  for (const ParityLimit& limit : kParityLimits)
    if (MatchesGlob(limit.cases, name) && MatchesGlob(limit.drivers, driver)) return limit;
  return kNoDifference;
}

std::string Slack(const Tolerance& t, double measured) {
  const double least = t.unit == Unit::Lsb ? std::ceil(measured) : std::ceil(2 * measured);
  if (t.limit <= least) return "";
  return std::string("tolerance ") + t.name + " on " + t.drivers + " is wider than it has to be: " +
         std::to_string(t.limit) + " " + ToString(t.unit) + ", measured " + std::to_string(measured) +
         "; tests/conformance/tolerances.cpp";
}

}  // namespace conformance
