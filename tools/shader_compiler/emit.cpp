#include "emit.h"

#include <filesystem>
#include <fstream>
#include <iomanip>
#include <sstream>

#include "error.h"

namespace shaderc {
namespace {

std::string Quote(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    if (c == '\n')
      out += "\\n";
    else
      out += c;
  }
  return out + "\"";
}

std::string QuoteLines(const std::string& text) {
  std::istringstream in(text);
  std::string out;
  for (std::string line; std::getline(in, line);) out += "    " + Quote(line + "\n") + "\n";
  return out;
}

// One table; `row` prints an element. An empty list has no table, and View() is then an empty Array.
template <class List, class Row>
void Table(std::ostream& out, const char* type, const char* name, const List& list, Row row) {
  if (list.empty()) return;
  out << "constexpr " << type << " " << name << "[] = {\n";
  for (const auto& item : list) {
    out << "    {";
    row(item);
    out << "},\n";
  }
  out << "};\n";
}

template <class List>
std::string View(const char* name, const List& list) {
  return list.empty() ? "{}" : "{" + std::string(name) + ", " + std::to_string(list.size()) + "}";
}

const char* KindName(rhi::ShaderResourceKind kind) {
  constexpr const char* kNames[] = {"Texture", "StructuredBuffer", "RWTexture", "RWStructuredBuffer"};
  return kNames[size_t(kind)];
}
const char* DimName(rhi::TextureDim dim) {
  constexpr const char* kNames[] = {"Tex2D", "Tex2DArray", "TexCube", "Tex3D", "Tex2DMS"};
  return kNames[size_t(dim)];
}
const char* StageName(rhi::Stage stage) {
  constexpr const char* kNames[] = {"Vertex", "Geometry", "Pixel", "Compute"};
  return kNames[size_t(stage)];
}
const char* TopologyName(rhi::PrimitiveTopology t) {
  constexpr const char* kNames[] = {"PointList",    "LineList",        "LineStrip",
                                    "TriangleList", "TriangleStrip",   "LineListAdj",
                                    "LineStripAdj", "TriangleListAdj", "TriangleStripAdj"};
  return kNames[size_t(t)];
}

void EmitSpirv(std::ostream& out, const std::vector<uint32_t>& words) {
  out << "constexpr uint32_t kSpirv[] = {" << std::hex << std::setfill('0');
  for (size_t i = 0; i < words.size(); ++i) out << (i % 10 ? " " : "\n    ") << "0x" << std::setw(8) << words[i] << ",";
  out << std::dec << "\n};\n";
}

void EmitTables(std::ostream& out, const Reflection& r) {
  Table(out, "rhi::ShaderConstantBuffer", "kConstantBuffers", r.constantBuffers,
        [&](const ConstantBuffer& b) { out << int(b.slot) << ", " << b.byteWidth << ", " << Quote(b.name); });
  Table(out, "rhi::ShaderResource", "kResources", r.resources, [&](const Resource& x) {
    out << "rhi::ShaderResourceKind::" << KindName(x.kind) << ", " << int(x.slot)
        << ", rhi::TextureDim::" << DimName(x.dim) << ", " << (x.integer ? "true" : "false") << ", " << x.stride << ", "
        << Quote(x.name);
  });
  Table(out, "rhi::ShaderSampler", "kSamplers", r.samplers,
        [&](const Sampler& s) { out << int(s.slot) << ", " << Quote(s.name); });
  Table(out, "rhi::ShaderTexturePair", "kPairs", r.pairs,
        [&](const rhi::ShaderTexturePair& p) { out << int(p.texture) << ", " << int(p.sampler); });
  Table(out, "rhi::ShaderInput", "kInputs", r.inputs,
        [&](const VertexInput& i) { out << Quote(i.semantic) << ", " << i.index << ", " << i.location; });
}

void EmitBlob(std::ostream& out, const Options& o, const Reflection& r) {
  const auto flag = [](bool b) { return b ? "true" : "false"; };
  out << "extern constinit const rhi::ShaderBlob " << o.symbol << "{\n"
      << "    .stage = rhi::Stage::" << StageName(o.stage) << ",\n    .name = " << Quote(o.name) << ",\n"
      << "    .spirv = {kSpirv, uint32_t(std::size(kSpirv))},\n    .glsl = kGlsl,\n    .reflection = {\n"
      << "        .constantBuffers = " << View("kConstantBuffers", r.constantBuffers) << ",\n"
      << "        .resources = " << View("kResources", r.resources) << ",\n"
      << "        .samplers = " << View("kSamplers", r.samplers) << ",\n"
      << "        .pairs = " << View("kPairs", r.pairs) << ",\n"
      << "        .inputs = " << View("kInputs", r.inputs) << ",\n"
      << "        .gsInput = rhi::PrimitiveTopology::" << TopologyName(r.gsInput) << ",\n"
      << "        .gsMaxVertices = " << r.gsMaxVertices << ",\n        .gsOutputComponents = " << r.gsOutputComponents
      << ",\n"
      << "        .usesVertexId = " << flag(r.usesVertexId) << ",\n        .usesInstanceId = " << flag(r.usesInstanceId)
      << ",\n        .writesLayer = " << flag(r.writesLayer) << ",\n        .groupSize = {" << r.groupSize[0] << ", "
      << r.groupSize[1] << ", " << r.groupSize[2] << "}}};\n";
}

// Make's rules: spaces and '#' take a backslash, '$' is doubled.
std::string EscapePath(const std::string& path) {
  std::string out;
  for (const char c : std::filesystem::absolute(path).lexically_normal().string()) {
    if (c == ' ' || c == '#') out += '\\';
    if (c == '$') out += '$';
    out += c;
  }
  return out;
}

}  // namespace

std::string EmitCpp(const Options& o, const std::vector<uint32_t>& spirv, const std::string& glsl,
                    const Reflection& r) {
  std::ostringstream out;
  out << "// Made by fur_shaderc from " << o.name
      << ". Do not edit.\n#include <iterator>\n\n#include \"rhi/shader.h\"\n\n"
      << "namespace " << o.nameSpace << " {\nnamespace {\n\n";
  EmitSpirv(out, spirv);
  out << "constexpr char kGlsl[] =\n" << QuoteLines(glsl) << "    ;\n";
  EmitTables(out, r);
  out << "\n}  // namespace\n\n";
  EmitBlob(out, o, r);
  out << "\n}  // namespace " << o.nameSpace << "\n";
  return out.str();
}

std::string EmitDepfile(const Options& o, const std::set<std::string>& includes) {
  std::string out = EscapePath(o.output) + ": " + EscapePath(o.input);
  for (const std::string& file : includes) out += " \\\n  " + EscapePath(file);
  return out + "\n";
}

void WriteFile(const std::string& path, const std::string& content) {
  std::ofstream out(path, std::ios::binary | std::ios::trunc);
  if (!(out << content) || !out.flush()) throw CompileError({path, 0}, "cannot write this file");
}

}  // namespace shaderc
