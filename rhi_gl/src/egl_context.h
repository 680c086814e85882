// EGL: where contexts can be made, without a display server unless a native display is given; and one context.
#pragma once

#include <string>
#include <vector>

#include "rhi/types.h"

namespace rhi_gl {

// One place where a context can be made: an EGL device, the surfaceless platform, or a native display.
struct EglPlace {
  unsigned platform = 0;   // EGL_PLATFORM_DEVICE_EXT and the like
  void* native = nullptr;  // what the platform asks for: an EGLDeviceEXT, nothing, an X11 Display
  bool software = false;   // EGL says that it is a CPU rasteriser
};

// Hardware first.
std::vector<EglPlace> ListEglPlaces(void* nativeDisplay);

struct EglContextDesc {
  int major = 4, minor = 5;  // 0.0: whatever the driver gives
  bool debug = false;
};

// Owns an EGL context without a surface, and its share of the display.
class EglContext {
 public:
  EglContext() = default;
  EglContext(const EglContext&) = delete;
  EglContext& operator=(const EglContext&) = delete;
  ~EglContext() { Destroy(); }

  // False, with the reason in *why.
  bool Create(const EglPlace&, const EglContextDesc&, std::string* why);
  void Destroy();
  bool MakeCurrent();
  void Release();  // no context is current on this thread afterwards
  bool IsCurrent() const;
  bool WasLost() const;      // why MakeCurrent, just called, gave false
  bool IsElsewhere() const;  // it is current on another thread
  int Error() const { return error_; }

  // The picture of an X11 window, an EGLSurface. Null, with the reason in *why.
  void* CreateWindowSurface(void* window, std::string* why);
  void DestroySurface(void* surface);
  // The context with the surface as its default framebuffer, until MakeCurrent. False: the window is gone.
  bool MakeCurrentOn(void* surface);
  void SetSwapInterval(int interval);              // of the surface that is current
  bool Swap(void* surface);                        // false: the window is gone
  void* NativeDisplay() const { return native_; }  // null: headless
  bool RobustAccess() const { return robust_; }
  const EglPlace& Place() const { return place_; }  // where Create was asked to make it

 private:
  bool OpenDisplay(const EglPlace&, std::string* why);

  EglPlace place_;
  void* native_ = nullptr;   // X11 Display
  void* display_ = nullptr;  // EGLDisplay
  void* context_ = nullptr;  // EGLContext
  void* config_ = nullptr;   // EGLConfig; null: the context goes with surfaces of any
  bool terminate_ = false;   // the display is counted and ends with its last context
  bool robust_ = false;
  int error_ = 0;  // of the last MakeCurrent that failed
};

}  // namespace rhi_gl
