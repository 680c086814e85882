#include "egl_context.h"

#include <epoxy/egl.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstring>
#include <mutex>

#include "xlib_window.h"

namespace rhi_gl {
namespace {

bool HasExtension(const char* list, const char* name) {
  if (!list) return false;
  const size_t length = std::strlen(name);
  for (const char* at = list; (at = std::strstr(at, name)) != nullptr; at += length)
    if ((at == list || at[-1] == ' ') && (at[length] == ' ' || at[length] == '\0')) return true;
  return false;
}

// A display is one object for the whole process, and eglTerminate ends it for everybody. Displays of devices and of the
// surfaceless platform are left to the end of the process; those of a native display must end before it is closed, so
// their contexts are counted.
class NativeDisplays {
 public:
  void Retain(EGLDisplay display) {
    const std::lock_guard lock(mutex_);
    displays_.push_back(display);
  }
  void Release(EGLDisplay display) {
    const std::lock_guard lock(mutex_);
    displays_.erase(std::find(displays_.begin(), displays_.end(), display));
    if (std::find(displays_.begin(), displays_.end(), display) == displays_.end()) eglTerminate(display);
  }

 private:
  std::mutex mutex_;
  std::vector<EGLDisplay> displays_;
};

NativeDisplays& SharedNativeDisplays() {
  static NativeDisplays displays;
  return displays;
}

std::vector<EglPlace> ListEglDevices() {
  EGLDeviceEXT devices[32];
  EGLint count = 0;
  if (!eglQueryDevicesEXT(EGLint(std::size(devices)), devices, &count)) return {};
  std::vector<EglPlace> places;
  for (EGLint i = 0; i < count; ++i) {
    const char* extensions = eglQueryDeviceStringEXT(devices[i], EGL_EXTENSIONS);
    places.push_back({EGL_PLATFORM_DEVICE_EXT, devices[i], HasExtension(extensions, "EGL_MESA_device_software")});
  }
  std::stable_partition(places.begin(), places.end(), [](const EglPlace& p) { return !p.software; });
  return places;
}

EGLContext TryContext(EGLDisplay display, EGLConfig config, const EglContextDesc& desc, bool robust, bool notify) {
  std::vector<EGLint> attributes;
  if (desc.major != 0)
    attributes.insert(attributes.end(),
                      {EGL_CONTEXT_MAJOR_VERSION_KHR, desc.major, EGL_CONTEXT_MINOR_VERSION_KHR, desc.minor,
                       EGL_CONTEXT_OPENGL_PROFILE_MASK_KHR, EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT_KHR});
  const EGLint flags =
      (desc.debug ? EGL_CONTEXT_OPENGL_DEBUG_BIT_KHR : 0) | (robust ? EGL_CONTEXT_OPENGL_ROBUST_ACCESS_BIT_KHR : 0);
  if (flags != 0) attributes.insert(attributes.end(), {EGL_CONTEXT_FLAGS_KHR, flags});
  if (notify)
    attributes.insert(attributes.end(),
                      {EGL_CONTEXT_OPENGL_RESET_NOTIFICATION_STRATEGY_KHR, EGL_LOSE_CONTEXT_ON_RESET_KHR});
  attributes.push_back(EGL_NONE);
  return eglCreateContext(display, config, EGL_NO_CONTEXT, attributes.data());
}

// Configs that can draw to windows, those without alpha first: an opaque window has none, and where a window has one, a
// compositor would blend with it. None has a depth buffer or samples if it can be helped: we draw elsewhere.
std::vector<EGLConfig> WindowConfigs(EGLDisplay display) {
  const EGLint wanted[] = {EGL_SURFACE_TYPE,
                           EGL_WINDOW_BIT,
                           EGL_RENDERABLE_TYPE,
                           EGL_OPENGL_BIT,
                           EGL_RED_SIZE,
                           8,
                           EGL_GREEN_SIZE,
                           8,
                           EGL_BLUE_SIZE,
                           8,
                           EGL_NONE};
  EGLint count = 0;
  if (!eglChooseConfig(display, wanted, nullptr, 0, &count) || count <= 0) return {};
  std::vector<EGLConfig> configs(static_cast<size_t>(count));
  if (!eglChooseConfig(display, wanted, configs.data(), count, &count)) return {};
  configs.resize(static_cast<size_t>(std::max(count, 0)));
  const auto cost = [&](EGLConfig config) {
    const auto get = [&](EGLint what) {
      EGLint value = 0;
      eglGetConfigAttrib(display, config, what, &value);
      return value;
    };
    // More than 8 bits, which EGL sorts first, would show our 8 bits too, but slowly.
    return std::array<EGLint, 3>{get(EGL_ALPHA_SIZE), get(EGL_RED_SIZE), get(EGL_DEPTH_SIZE) + get(EGL_SAMPLES)};
  };
  std::stable_sort(configs.begin(), configs.end(), [&](EGLConfig a, EGLConfig b) { return cost(a) < cost(b); });
  return configs;
}

// EGL_NO_CONFIG_KHR where it is offered (its value is null), else the first config of desktop GL that suits the place.
bool ChooseConfig(EGLDisplay display, bool windows, EGLConfig* config) {
  *config = nullptr;
  const char* extensions = eglQueryString(display, EGL_EXTENSIONS);
  if (HasExtension(extensions, "EGL_KHR_no_config_context") || HasExtension(extensions, "EGL_MESA_configless_context"))
    return true;
  if (windows) {
    const std::vector<EGLConfig> configs = WindowConfigs(display);
    if (!configs.empty()) *config = configs.front();
    return !configs.empty();
  }
  const EGLint wanted[] = {EGL_SURFACE_TYPE, 0, EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_NONE};
  EGLint count = 0;
  return eglChooseConfig(display, wanted, config, 1, &count) && count == 1;
}

}  // namespace

std::vector<EglPlace> ListEglPlaces(void* nativeDisplay) {
  if (nativeDisplay) return {{EGL_PLATFORM_X11_EXT, nativeDisplay, false}};
  const char* extensions = eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
  std::vector<EglPlace> places;
  const bool enumerates =
      HasExtension(extensions, "EGL_EXT_device_enumeration") || HasExtension(extensions, "EGL_EXT_device_base");
  if (enumerates && HasExtension(extensions, "EGL_EXT_platform_device")) places = ListEglDevices();
  // Mesa's surfaceless platform picks a driver by itself; it is the last resort because it names none.
  if (places.empty() && HasExtension(extensions, "EGL_MESA_platform_surfaceless"))
    places.push_back({EGL_PLATFORM_SURFACELESS_MESA, nullptr, false});
  return places;
}

bool EglContext::OpenDisplay(const EglPlace& place, std::string* why) {
  // Not the core eglGetPlatformDisplay: libepoxy aborts in it as long as no display tells the EGL version.
  EGLDisplay display = eglGetPlatformDisplayEXT(place.platform, place.native, nullptr);
  if (!display || !eglInitialize(display, nullptr, nullptr)) {
    *why = "EGL could not open the display";
    return false;
  }
  display_ = display;
  terminate_ = place.platform == EGL_PLATFORM_X11_EXT;
  native_ = terminate_ ? place.native : nullptr;
  if (terminate_) SharedNativeDisplays().Retain(display);
  const char* extensions = eglQueryString(display, EGL_EXTENSIONS);
  const bool fit =
      HasExtension(extensions, "EGL_KHR_create_context") && HasExtension(extensions, "EGL_KHR_surfaceless_context");
  if (!fit) *why = "EGL lacks EGL_KHR_create_context or EGL_KHR_surfaceless_context";
  return fit;
}

bool EglContext::Create(const EglPlace& place, const EglContextDesc& desc, std::string* why) {
  place_ = place;
  if (!OpenDisplay(place, why)) return false;
  if (!eglBindAPI(EGL_OPENGL_API) || !ChooseConfig(display_, terminate_, &config_)) {
    *why = "EGL offers no desktop OpenGL";
    return false;
  }
  // Robust access makes reads out of bounds give 0, as Direct3D's do; what a driver refuses is left out.
  context_ = TryContext(display_, config_, desc, true, true);
  if (!context_) context_ = TryContext(display_, config_, desc, true, false);
  robust_ = context_ != nullptr;
  if (!context_) context_ = TryContext(display_, config_, desc, false, false);
  if (context_ && MakeCurrent()) return true;
  *why = "EGL refused a context of OpenGL " + std::to_string(desc.major) + "." + std::to_string(desc.minor) + " core";
  return false;
}

void EglContext::Destroy() {
  if (context_) {
    if (IsCurrent()) Release();
    eglDestroyContext(display_, context_);
  }
  if (terminate_) SharedNativeDisplays().Release(display_);
  display_ = context_ = config_ = nullptr;
  terminate_ = false;
}

bool EglContext::MakeCurrent() {
  eglBindAPI(EGL_OPENGL_API);  // a state of each thread
  if (eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_) == EGL_TRUE) return true;
  error_ = eglGetError();
  return false;
}

void EglContext::Release() { eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT); }

bool EglContext::WasLost() const { return error_ == EGL_CONTEXT_LOST; }

bool EglContext::IsElsewhere() const { return error_ == EGL_BAD_ACCESS; }

bool EglContext::IsCurrent() const { return eglGetCurrentContext() == context_; }

void* EglContext::CreateWindowSurface(void* window, std::string* why) {
  unsigned long id = reinterpret_cast<uintptr_t>(window);
  XlibWindowInfo info;
  if (!QueryXlibWindow(native_, id, &info)) {
    *why = "there is no such window on nativeDisplay";
    return nullptr;
  }
  std::vector<EGLConfig> configs = config_ ? std::vector<EGLConfig>{config_} : WindowConfigs(display_);
  // A config of another visual than the window's may be refused now, or end in an X error later.
  std::stable_partition(configs.begin(), configs.end(), [&](EGLConfig config) {
    EGLint visual = 0;
    eglGetConfigAttrib(display_, config, EGL_NATIVE_VISUAL_ID, &visual);
    return static_cast<unsigned long>(visual) == info.visual;
  });
  for (EGLConfig config : configs)  // X11's platform takes a pointer to the Window
    if (EGLSurface surface = eglCreatePlatformWindowSurfaceEXT(display_, config, &id, nullptr)) return surface;
  char text[128];
  std::snprintf(text, sizeof text, "EGL cannot draw to this window (error 0x%04x, %zu configs tried)",
                unsigned(eglGetError()), configs.size());
  *why = text;
  return nullptr;
}

void EglContext::DestroySurface(void* surface) { eglDestroySurface(display_, surface); }

bool EglContext::MakeCurrentOn(void* surface) {
  eglBindAPI(EGL_OPENGL_API);
  return eglMakeCurrent(display_, surface, surface, context_) == EGL_TRUE;
}

void EglContext::SetSwapInterval(int interval) { eglSwapInterval(display_, interval); }

bool EglContext::Swap(void* surface) { return eglSwapBuffers(display_, surface) == EGL_TRUE; }

}  // namespace rhi_gl
