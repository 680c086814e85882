#include "options.h"

#include <cctype>
#include <map>

#include "error.h"

namespace shaderc {
namespace {

rhi::Stage ParseStage(const std::string& text) {
  if (text == "vs") return rhi::Stage::Vertex;
  if (text == "gs") return rhi::Stage::Geometry;
  if (text == "ps") return rhi::Stage::Pixel;
  if (text == "cs") return rhi::Stage::Compute;
  throw CompileError("unknown stage '" + text + "'; one of vs, gs, ps, cs");
}

bool IsIdentifier(const std::string& text) {
  if (text.empty() || std::isdigit(static_cast<unsigned char>(text[0]))) return false;
  for (unsigned char c : text)
    if (!std::isalnum(c) && c != '_') return false;
  return true;
}

void Complete(Options& o) {
  if (o.input.empty() || o.output.empty() || o.entry.empty()) throw CompileError(Usage());
  if (!IsIdentifier(o.symbol)) throw CompileError("--symbol '" + o.symbol + "' is not a C++ identifier");
  if (!IsIdentifier(o.entry)) throw CompileError("--entry '" + o.entry + "' is not an identifier");
  if (!IsIdentifier(o.nameSpace)) throw CompileError("--namespace '" + o.nameSpace + "' is not a C++ identifier");
  if (o.name.empty()) o.name = o.input + ":" + o.entry;
}

}  // namespace

const char* Usage() {
  return "usage: fur_shaderc --stage vs|gs|ps|cs --entry NAME --symbol NAME --namespace NAME [--name TEXT] [-I "
         "DIR]...\n"
         "                   [-D NAME[=VALUE]]... [--depfile FILE] [--dump-spirv FILE] [--dump-glsl FILE] -o OUT.cpp "
         "INPUT.hlsl";
}

const char* StagePrefix(rhi::Stage stage) {
  constexpr const char* kPrefix[] = {"vs", "gs", "ps", "cs"};
  return kPrefix[size_t(stage)];
}

Options ParseOptions(const std::vector<std::string>& args) {
  Options o;
  std::string stage;
  const std::map<std::string, std::string*> single{
      {"--stage", &stage},     {"--entry", &o.entry},          {"--name", &o.name},
      {"--symbol", &o.symbol}, {"--namespace", &o.nameSpace},  {"--depfile", &o.depfile},
      {"-o", &o.output},       {"--dump-spirv", &o.dumpSpirv}, {"--dump-glsl", &o.dumpGlsl}};
  const std::map<std::string, std::vector<std::string>*> many{{"-I", &o.includeDirs}, {"-D", &o.defines}};
  for (size_t i = 0; i < args.size(); ++i) {
    const auto one = single.find(args[i]);
    const auto list = many.find(args[i]);
    const bool isOption = one != single.end() || list != many.end();
    if (isOption && i + 1 == args.size()) throw CompileError(args[i] + " needs a value");
    if (one != single.end())
      *one->second = args[++i];
    else if (list != many.end())
      list->second->push_back(args[++i]);
    else if (args[i].starts_with("-") || !o.input.empty())
      throw CompileError("unknown argument '" + args[i] + "'\n" + Usage());
    else
      o.input = args[i];
  }
  Complete(o);
  o.stage = ParseStage(stage);
  return o;
}

}  // namespace shaderc
