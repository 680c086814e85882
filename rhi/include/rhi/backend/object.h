// For backends: what every object shares (counting, name), messages, and interning of state objects.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstdarg>
#include <cstdio>
#include <string>
#include <vector>

#include "rhi/device.h"

namespace rhi::backend {

// Implements IObject for a final class of `Interface`. A new object is born with one count (see Ref::Adopt). The last
// Release calls Destroy, which a backend overrides where the GPU may still use the object.
template <class Interface>
class Object : public Interface {
 public:
  uint32_t AddRef() noexcept final { return refs_.fetch_add(1, std::memory_order_relaxed) + 1; }
  uint32_t Release() noexcept final {
    const uint32_t left = refs_.fetch_sub(1, std::memory_order_acq_rel) - 1;
    if (left == 0) Destroy();
    return left;
  }
  void SetName(const char* name) override { name_ = name ? name : ""; }
  const std::string& Name() const { return name_; }

 protected:
  virtual void Destroy() noexcept { delete this; }

 private:
  std::atomic<uint32_t> refs_{1};
  std::string name_;
};

// Formats messages for the device's sink; without a sink they are dropped.
class MessageLog {
 public:
  explicit MessageLog(IMessageSink* sink = nullptr) : sink_(sink) {}

  // printf-style. `object` is a name or "".
  [[gnu::format(printf, 5, 6)]] void Report(Severity severity, MsgCode code, const char* object, const char* format,
                                            ...) const {
    if (!sink_) return;
    char text[1024];
    va_list args;
    va_start(args, format);
    std::vsnprintf(text, sizeof text, format, args);
    va_end(args);
    sink_->OnMessage({severity, code, object ? object : "", text, 0});
  }
  void Forward(const Message& message) const {
    if (sink_) sink_->OnMessage(message);
  }
  IMessageSink* Sink() const { return sink_; }

 private:
  IMessageSink* sink_;
};

// Equal descriptors give the same object for as long as somebody holds it. The table holds no count: an object removes
// itself with Forget before it dies. State objects are few, so a linear search is enough.
template <class Desc, class State>
class Interner {
 public:
  // Returns the living object of an equal descriptor, or null.
  Ref<State> Find(const Desc& desc) const {
    for (State* s : states_)
      if (s->Desc() == desc) return Ref<State>(s);
    return {};
  }
  void Remember(State* state) { states_.push_back(state); }
  void Forget(State* state) { std::erase(states_, state); }

 private:
  std::vector<State*> states_;
};

}  // namespace rhi::backend
