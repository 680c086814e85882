#include "drivers.h"

#include <algorithm>
#include <cctype>

namespace conformance {
namespace {

DriverInfo& Vulkan() {
  static DriverInfo info{.backend = "vulkan"};
  return info;
}
DriverInfo& Gl() {
  static DriverInfo info{.backend = "gl"};
  return info;
}

// Letters and digits of the adapter's name, in small letters, dashes between: "nvidia-h100-pcie".
std::string Slug(const std::string& adapter) {
  std::string slug;
  for (const char c : adapter) {
    if (std::isalnum(static_cast<unsigned char>(c)))
      slug += char(std::tolower(static_cast<unsigned char>(c)));
    else if (!slug.empty() && slug.back() != '-')
      slug += '-';
  }
  while (!slug.empty() && slug.back() == '-') slug.pop_back();
  return slug;
}

std::string ShortName(rhi::Backend backend, const std::string& adapter) {
  const auto has = [&](const char* word) { return adapter.find(word) != std::string::npos; };
  if (has("SwiftShader")) return "swiftshader";
  if (has("zink")) return "zink";  // before llvmpipe: its name tells what it runs on
  if (has("llvmpipe")) return backend == rhi::Backend::Vulkan ? "lavapipe" : "llvmpipe";
  if (has("softpipe")) return "softpipe";
  return Slug(adapter);
}

}  // namespace

std::string BackendName(rhi::Backend backend) { return backend == rhi::Backend::Vulkan ? "vulkan" : "gl"; }

DriverInfo Describe(const rhi::Caps& caps) {
  const std::string backend = BackendName(caps.backend), adapter = caps.adapter.data();
  return {.present = true,
          .backend = backend,
          .key = backend + ":" + ShortName(caps.backend, adapter),
          .adapter = adapter,
          .driver = caps.driver.data()};
}

void SetDrivers(const DriverInfo& vulkan, const DriverInfo& gl) {
  Vulkan() = vulkan;
  Gl() = gl;
}

const DriverInfo& DriverOf(const std::string& backend) { return backend == "vulkan" ? Vulkan() : Gl(); }

std::string DriverKeyOf(const std::string& backend) {
  if (backend == "cpu") return "cpu";
  if (backend == "both") return OddDriver();
  return DriverOf(backend).key;
}

std::string DriverLabelOf(const std::string& backend) {
  return backend == "both" ? Vulkan().key + " " + Gl().key : DriverKeyOf(backend);
}

std::string OddDriver() { return Vulkan().key == "vulkan:lavapipe" || !Vulkan().present ? Gl().key : Vulkan().key; }

}  // namespace conformance
