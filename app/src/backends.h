// The one place that knows which backends exist.
#pragma once

#include <string>
#include <vector>

#include "fur/result.h"
#include "rhi/rhi.h"

namespace app {

struct BackendEntry {
  const char* name;  // as the --backend flag says it
  rhi::Status (*createDevice)(const rhi::DeviceDesc&, rhi::Ref<rhi::IDevice>*);
  std::vector<rhi::Caps> (*enumerateAdapters)();
};
const std::vector<BackendEntry>& Backends();

// The backends that a --backend value means: one, or all for "both".
std::vector<const BackendEntry*> SelectBackends(const std::string& flag);

// Collects what drivers and the RHI say.
class MessageCollector final : public rhi::IMessageSink {
 public:
  void OnMessage(const rhi::Message&) override;
  const std::vector<std::string>& Lines() const { return lines_; }  // warnings and worse, as "severity code: text"
  std::string Last() const { return lines_.empty() ? std::string() : lines_.back(); }

 private:
  std::vector<std::string> lines_;
};

// NoDevice says what the driver said.
fur::Result<rhi::Ref<rhi::IDevice>> MakeDevice(const BackendEntry&, const std::string& adapter, bool validate,
                                               MessageCollector* messages);

}  // namespace app
