#include "backends.h"

#include <fmt/format.h>

#include "rhi_gl/rhi_gl.h"
#include "rhi_vulkan/rhi_vulkan.h"

namespace app {

const std::vector<BackendEntry>& Backends() {
  static const std::vector<BackendEntry> backends{
      {"vulkan", rhi_vulkan::CreateDevice, rhi_vulkan::EnumerateAdapters},
      {"gl", rhi_gl::CreateDevice, rhi_gl::EnumerateAdapters},
  };
  return backends;
}

std::vector<const BackendEntry*> SelectBackends(const std::string& flag) {
  std::vector<const BackendEntry*> selected;
  for (const BackendEntry& b : Backends())
    if (flag == "both" || flag == b.name) selected.push_back(&b);
  return selected;
}

fur::Result<rhi::Ref<rhi::IDevice>> MakeDevice(const BackendEntry& backend, const std::string& adapter, bool validate,
                                               MessageCollector* messages) {
  rhi::Ref<rhi::IDevice> device;
  const rhi::DeviceDesc desc{.apiValidation = validate, .syncValidation = validate, .adapter = adapter.c_str(), .sink = messages};
  const rhi::Status status = backend.createDevice(desc, &device);
  if (status == rhi::Status::Ok) return device;
  const std::string why = messages->Lines().empty() ? rhi::ToString(status) : messages->Last();
  return fur::Error{fur::ErrorCode::NoDevice, fmt::format("no {} device: {}", backend.name, why)};
}

void MessageCollector::OnMessage(const rhi::Message& m) {
  if (m.severity == rhi::Severity::Info) return;
  const std::string object = *m.object ? fmt::format(" [{}]", m.object) : "";
  lines_.push_back(fmt::format("{} {}{}: {}", ToString(m.severity), ToString(m.code), object, m.text));
}

}  // namespace app
