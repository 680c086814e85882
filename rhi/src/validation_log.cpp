#include "validation_log.h"

namespace rhi::validation {

void Validation::Say(Severity severity, MsgCode code, const Subject& subject, const char* format, va_list args) {
  if (!sink_) return;
  const char* name = subject.name ? subject.name : objects.NameOf(subject.object);
  if (!said_.emplace(code, subject.object, name).second) return;
  char text[1024];
  std::vsnprintf(text, sizeof text, format, args);
  sink_->OnMessage({severity, code, name, text, 0});
}

bool Validation::Error(MsgCode code, const Subject& subject, const char* format, ...) {
  va_list args;
  va_start(args, format);
  Say(Severity::Error, code, subject, format, args);
  va_end(args);
  return false;
}

bool Validation::Warn(MsgCode code, const Subject& subject, const char* format, ...) {
  va_list args;
  va_start(args, format);
  Say(Severity::Warning, code, subject, format, args);
  va_end(args);
  return true;
}

bool Validation::Inform(MsgCode code, const Subject& subject, const char* format, ...) {
  va_list args;
  va_start(args, format);
  Say(Severity::Info, code, subject, format, args);
  va_end(args);
  return true;
}

bool Validation::Owns(const char* call, const IObject* object) {
  if (!object || objects.Find(object)) return true;
  return Error(MsgCode::ForeignObject, object,
               "%s: the object is of another device, was made before the wrapping, or is destroyed; make it with the "
               "device whose context uses it, and hold it while you use it; the call is ignored",
               call);
}

}  // namespace rhi::validation
