#include "xlib_window.h"

#include <X11/Xlib.h>

namespace rhi_gl {
namespace {

// Takes the errors of the requests made while it lives, and leaves those of earlier ones to the program's handler. Xlib
// has one handler for the whole process.
class ErrorTrap {
 public:
  explicit ErrorTrap(Display* display) : firstRequest_(NextRequest(display)) {
    active_ = this;
    before_ = XSetErrorHandler(&ErrorTrap::OnError);
  }
  ~ErrorTrap() {
    XSetErrorHandler(before_);
    active_ = nullptr;
  }
  ErrorTrap(const ErrorTrap&) = delete;
  ErrorTrap& operator=(const ErrorTrap&) = delete;

 private:
  static int OnError(Display* display, XErrorEvent* event) {
    const ErrorTrap* trap = active_;
    if (!trap || event->serial >= trap->firstRequest_ || !trap->before_) return 0;
    return trap->before_(display, event);
  }

  static thread_local ErrorTrap* active_;
  unsigned long firstRequest_;
  XErrorHandler before_ = nullptr;
};

thread_local ErrorTrap* ErrorTrap::active_ = nullptr;

}  // namespace

bool QueryXlibWindow(void* display, unsigned long window, XlibWindowInfo* out) {
  auto* x = static_cast<Display*>(display);
  const ErrorTrap trap(x);
  XWindowAttributes at{};
  if (!XGetWindowAttributes(x, window, &at)) return false;
  *out = {static_cast<unsigned>(at.width), static_cast<unsigned>(at.height), XVisualIDFromVisual(at.visual)};
  return true;
}

bool QueryXlibSize(void* display, unsigned long window, XlibWindowInfo* out) {
  auto* x = static_cast<Display*>(display);
  const ErrorTrap trap(x);
  ::Window root = 0;
  int left = 0, top = 0;
  unsigned border = 0, depth = 0;
  return XGetGeometry(x, window, &root, &left, &top, &out->width, &out->height, &border, &depth) != 0;
}

}  // namespace rhi_gl
