// What the validating device, its context and its swap chains share: the messages and the table of objects.
#pragma once

#include <set>
#include <tuple>

#include "rhi/backend/object.h"
#include "validation_objects.h"

namespace rhi::validation {

// What a message is about: an object of this device, and a name where its own says too little (a register's, say).
struct Subject {
  Subject(const IObject* o = nullptr, const char* n = nullptr) : object(o), name(n) {}
  const IObject* object;
  const char* name;
};

class Validation {
 public:
  explicit Validation(IMessageSink* sink) : sink_(sink) {}

  // printf-style; each gives what the caller's check gives: an Error fails it, a Warning does not.
  [[gnu::format(printf, 4, 5)]] bool Error(MsgCode, const Subject&, const char* format, ...);
  [[gnu::format(printf, 4, 5)]] bool Warn(MsgCode, const Subject&, const char* format, ...);
  [[gnu::format(printf, 4, 5)]] bool Inform(MsgCode, const Subject&, const char* format, ...);
  void NewFrame() { said_.clear(); }

  // Whether the object is null or of this device; reports it otherwise, without looking into it.
  bool Owns(const char* call, const IObject*);

  ObjectTable objects;
  backend::MessageLog quiet;  // for the shadow state: the backend reports the same

 private:
  void Say(Severity, MsgCode, const Subject&, const char* format, va_list);
  IMessageSink* sink_;
  std::set<std::tuple<MsgCode, const IObject*, std::string>> said_;  // in this frame
};

}  // namespace rhi::validation
