// fur bake: grows a coat and writes it as a folder of pictures.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <map>

#include "commands.h"
#include "fur/bake_files.h"
#include "fur/coat_file.h"
#include "progress_bar.h"

namespace app {
namespace {

using fur::Done;
using fur::Error;
using fur::ErrorCode;
using fur::Result;

struct BakeFlags {
  std::string output, coat, strands;
  uint32_t threads = 0;
  bool progress = false, noMips = false;
  std::map<const fur::CoatKey*, std::string> values;  // as given
};

// --over-length for length of over.
std::string FlagName(const fur::CoatKey& key) {
  std::string name = (*key.group != '\0' ? std::string(key.group) + "-" : std::string()) + key.name;
  std::replace(name.begin(), name.end(), '_', '-');
  return "--" + name;
}

Result<double> ParseNumber(const std::string& text, const std::string& flag) {
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  if (!text.empty() && end == text.c_str() + text.size()) return value;
  return Error{ErrorCode::Usage, fmt::format("{} takes a number, not '{}'", flag, text)};
}

Result<fur::CoatParams> MakeParams(const BakeFlags& f) {
  fur::CoatParams params;
  if (!f.coat.empty()) {
    Result<fur::Coat> coat = fur::LoadCoat(f.coat);
    if (!coat) return coat.error();
    params = coat->strands;
  }
  for (const auto& [key, text] : f.values) {
    const std::string flag = FlagName(*key);
    Result<double> value = ParseNumber(text, flag);
    if (!value) return value.error();
    if (Result<Done> set = fur::SetCoatValue(*key, *value, &params); !set)
      return Error{ErrorCode::Usage, flag + " " + set.error().message};
  }
  if (Result<Done> ok = fur::CheckCoat(params); !ok) return ok.error();
  return params;
}

void PrintSummary(const BakeFlags& f, const fur::BakedCoat& coat, double seconds) {
  size_t over = 0;
  for (const fur::Strand& strand : coat.strands) over += strand.kind == fur::StrandKind::Over;
  fmt::print("{}: {} strands ({} undercoat, {} overcoat) in {} x {} x {} texels, {:.2f} s\n", f.output,
             coat.strands.size(), coat.strands.size() - over, over, coat.params.size, coat.params.size,
             coat.params.layers, seconds);
}

Result<Done> RunBake(const BakeFlags& f) {
  const auto start = std::chrono::steady_clock::now();
  Result<fur::CoatParams> params = MakeParams(f);
  if (!params) return params.error();
  const fur::CoatOutput output{f.output, f.strands, !f.noMips, f.threads};
  if (Result<Done> ok = fur::CheckCoatOutput(output); !ok) return ok;
  fur::BakedCoat coat;
  {
    ProgressBar bar(f.progress);
    coat = fur::Bake(*params, f.threads, [&](double share) { bar.Show("baking", share * 0.6); });
    const auto writing = [&](double share) { bar.Show("writing", 0.6 + share * 0.4); };
    if (Result<Done> written = fur::WriteCoat(output, coat, writing); !written) return written;
  }
  PrintSummary(f, coat, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  return Done{};
}

void AddKeyFlags(CLI::App* c, BakeFlags* f) {
  const fur::CoatParams defaults;
  for (const fur::CoatKey& key : fur::CoatKeys()) {
    const std::string range = fmt::format("{}..{}; {}", key.min, key.max, fur::CoatValue(defaults, key));
    const bool isClass = *key.group != '\0';
    c->add_option_function<std::string>(
         FlagName(key), [f, k = &key](const std::string& text) { f->values[k] = text; },
         fmt::format("{} ({})", key.help, range))
        ->type_name(key.whole ? "N" : "X")
        ->group(!isClass                            ? "The coat (range; default)"
                : key.group == std::string("under") ? "Undercoat"
                                                    : "Overcoat");
  }
}

}  // namespace

void AddBakeCommand(CLI::App& app, Command* run) {
  auto flags = std::make_shared<BakeFlags>();
  CLI::App* c = app.add_subcommand("bake", "Grow a coat of strands and write it as the layers of a fur volume");
  c->add_option("-o,--output", flags->output, "Folder to write; appears whole or not at all")->required();
  c->add_option("--coat", flags->coat, "Strands of a coat: a name (fur info --coats) or a JSON file (docs/coats.md), as coat.json in a baked folder; flags win");
  c->add_option("--strands", flags->strands, "Also write the strands, as polylines, to this .json or .ply");
  c->add_option("--threads", flags->threads, "Threads, 0..256; 0: one for each core. The bytes do not depend on it")
      ->check(CLI::Range(0u, 256u))
      ->capture_default_str();
  c->add_flag("--no-mips", flags->noMips, "Leave out the mips");
  c->add_flag("--progress", flags->progress, "Show the progress bar even where stderr is no terminal");
  AddKeyFlags(c, flags.get());
  c->callback([flags, run] { *run = Running(flags, RunBake); });
}

}  // namespace app
