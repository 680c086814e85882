#include "preset_flags.h"

#include <fmt/format.h>

#include <algorithm>

namespace app {
namespace {

using fur::Error;
using fur::ErrorCode;
using fur::Preset;

struct Owned {
  const char* flag;
  std::set<Preset> owners;
};

// Flags that act in some presets only; those of technique shells alone act in none.
const Owned kOwned[] = {
    {"--coat", {Preset::FourCoats}},
    {"--dead-zone", {Preset::GsShells, Preset::FourCoats}},
    {"--fin-threshold", {Preset::NvidiaD3d10}},
    {"--fin-opacity", {Preset::NvidiaD3d10}},
    {"--comb", {Preset::NvidiaD3d10}},
    {"--comb-strength", {Preset::NvidiaD3d10}},
    {"--bend", {}},
    {"--shell-mode", {}},
    {"--shells-at-once", {}},
    {"--fins", {}},
    {"--no-back-faces", {}},
    {"--no-sort", {}},
};

// What technique shells alone makes of a coat.
const char* const kGroom[] = {"--density",        "--thickness",   "--gravity",         "--root-color",
                              "--tip-color",      "--wetness",     "--color-from-base", "--clumping",
                              "--wind",           "--wind-strength", "--wind-frequency", "--wind-length",
                              "--inertia-stiffness", "--inertia-damping", "--time"};

// The preset's own four, not those of docs/coats.md.
fur::Result<fur::Done> SetFourCoat(const std::string& coat, fur::RenderSettings* s) {
  const std::initializer_list<std::pair<const char*, fur::FourCoat>> coats = {{"bear", fur::FourCoat::Bear},
                                                                              {"panther", fur::FourCoat::Panther},
                                                                              {"snow", fur::FourCoat::Snow},
                                                                              {"tiger", fur::FourCoat::Tiger}};
  const bool known = std::any_of(coats.begin(), coats.end(), [&](const auto& c) { return coat == c.first; });
  if (!coat.empty() && !known)
    return Error{ErrorCode::Usage,
                 fmt::format("--preset four-coats has the coats bear, panther, snow, tiger, not '{}'", coat)};
  s->fourCoat = Choose<fur::FourCoat>(coat, coats);
  return fur::Done{};
}

}  // namespace

fur::Result<fur::Done> SetPreset(const std::string& preset, const std::string& coat, const std::set<std::string>& given,
                                 fur::RenderSettings* s) {
  const auto has = [&](const char* flag) { return given.contains(flag); };
  for (const char* flag : kGroom)
    if (has(flag) && (!preset.empty() || s->technique == fur::Technique::Seed))
      return Error{ErrorCode::Usage, fmt::format("{} does nothing in {}", flag,
                                                 preset.empty() ? "--technique seed" : "--preset " + preset)};
  if (preset.empty()) {
    if (has("--dead-zone")) return Error{ErrorCode::Usage, "--dead-zone belongs to a --preset that has it"};
    return fur::Done{};
  }
  s->preset = Choose<Preset>(preset, {{"demo-fur", Preset::DemoFur},
                                      {"nvidia-d3d10", Preset::NvidiaD3d10},
                                      {"gs-shells", Preset::GsShells},
                                      {"four-coats", Preset::FourCoats}});
  const bool demo = s->preset == Preset::DemoFur;
  if (has("--technique") && s->technique != fur::Technique::Seed)
    return Error{ErrorCode::Usage,
                 fmt::format("--preset {} is drawn by --technique seed, not by --technique shells", preset)};
  if (has("--look") && s->look != fur::Look::Seed && !demo)
    return Error{ErrorCode::Usage,
                 fmt::format("--preset {} has its own look: --look correct is for other pictures", preset)};
  if (has("--semantics") && !demo)
    return Error{ErrorCode::Usage,
                 fmt::format("--preset {} draws its shells as sheets: --semantics does not go with it", preset)};
  for (const Owned& o : kOwned)
    if (has(o.flag) && !o.owners.contains(s->preset))
      return Error{ErrorCode::Usage, fmt::format("{} does nothing in --preset {}", o.flag, preset)};
  if (fur::Result<fur::Done> known = SetFourCoat(coat, s); !known) return known;
  s->technique = fur::Technique::Seed;
  if (!has("--look")) s->look = fur::Look::Seed;
  return fur::Done{};
}

}  // namespace app
