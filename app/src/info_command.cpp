#include <fmt/format.h>

#include "backends.h"
#include "commands.h"
#include "fur/coat_file.h"
#include "fur/params.h"

namespace app {
namespace {

void PrintFlags(const rhi::Caps& c) {
  const std::pair<const char*, bool> flags[] = {{"geometry shader", c.geometryShader},
                                                {"layered rendering", c.layeredRendering},
                                                {"compute", c.compute},
                                                {"indirect draws", c.drawIndirect},
                                                {"independent blend", c.independentBlend},
                                                {"dual-source blend", c.dualSourceBlend},
                                                {"alpha to coverage", c.alphaToCoverage},
                                                {"anisotropic filtering", c.samplerAnisotropy},
                                                {"BC textures", c.textureCompressionBC},
                                                {"wireframe", c.wireframe},
                                                {"depth clip off", c.depthClipDisable},
                                                {"timestamps", c.timestamp},
                                                {"precise occlusion", c.occlusionPrecise},
                                                {"pipeline statistics", c.pipelineStatistics},
                                                {"debug markers", c.debugMarkers},
                                                {"swap chain", c.swapChain},
                                                {"software", c.software}};
  std::string have, lack;
  for (const auto& [name, on] : flags) {
    std::string& list = on ? have : lack;
    list += (list.empty() ? "" : ", ") + std::string(name);
  }
  fmt::print("    has      {}\n", have.empty() ? "-" : have);
  fmt::print("    lacks    {}\n", lack.empty() ? "-" : lack);
}

void PrintCaps(const rhi::Caps& c) {
  fmt::print("  {}\n    driver   {}, API {}.{}\n", c.adapter.data(), c.driver.data(), c.apiMajor, c.apiMinor);
  fmt::print("    limits   textures {0} x {0}, {1} slices, 3D {2}, {3} samples, GS {4} vertices / {5} components\n", c.maxTexture2D,
             c.maxArrayLayers, c.maxTexture3D, c.maxColorSamples, c.maxGSOutputVertices, c.maxGSOutputComponents);
  PrintFlags(c);
}

int PrintInfo() {
  size_t found = 0;
  for (const BackendEntry& backend : Backends()) {
    const std::vector<rhi::Caps> adapters = backend.enumerateAdapters();
    fmt::print("{}: {} adapter{}\n", backend.name, adapters.size(), adapters.size() == 1 ? "" : "s");
    for (const rhi::Caps& caps : adapters) PrintCaps(caps);
    found += adapters.size();
  }
  if (found > 0) return 0;
  return Fail({fur::ErrorCode::NoDevice, "neither a Vulkan nor an OpenGL driver was found; install mesa-vulkan-drivers and libgl1-mesa-dri"});
}

int PrintSchema() {
  fmt::print("{}", fur::GroomSchema());
  return 0;
}

int PrintCoats() {
  for (const fur::EmbeddedCoat& embedded : fur::EmbeddedCoats()) {
    const fur::Result<fur::Coat> coat = fur::LoadCoat(embedded.name);
    if (!coat) return Fail(coat.error());
    fmt::print("{:<14}{}\n", embedded.name, coat->title);
  }
  return 0;
}

}  // namespace

void AddInfoCommand(CLI::App& app, Command* run) {
  CLI::App* info = app.add_subcommand("info", "List adapters, drivers and what they can do");
  auto schema = std::make_shared<bool>(false);
  info->add_flag("--groom-schema", *schema, "Print the JSON schema of fur files (render --groom) instead");
  auto coats = std::make_shared<bool>(false);
  info->add_flag("--coats", *coats, "List the coats of render --coat and bake --coat instead");
  info->callback([run, schema, coats] { *run = *schema ? PrintSchema : *coats ? PrintCoats : PrintInfo; });
}

}  // namespace app
