#include "window.h"

#include <GLFW/glfw3.h>
#include <X11/Xlib.h>
#include <X11/Xutil.h>

#include <stdexcept>
#include <utility>

// As <GLFW/glfw3native.h> declares them; that one includes Xrandr's header too, which would be one more package.
extern "C" Display* glfwGetX11Display(void);
extern "C" Window glfwGetX11Window(GLFWwindow*);

namespace rhi_test {
namespace {

std::string xErrors;

int OnXError(Display* display, XErrorEvent* event) {
  char text[256] = "";
  XGetErrorText(display, event->error_code, text, sizeof text);
  xErrors += std::string(text) + " in request " + std::to_string(event->request_code) + "." +
             std::to_string(event->minor_code) + "\n";
  return 0;
}

void Sync() {
  XSync(glfwGetX11Display(), False);
  glfwPollEvents();
}

uint8_t Channel(unsigned long pixel, unsigned long mask) {
  unsigned long value = pixel & mask, most = mask;
  while (most && !(most & 1)) {
    most >>= 1;
    value >>= 1;
  }
  return most ? static_cast<uint8_t>(value * 255 / most) : uint8_t(0);
}

}  // namespace

std::string StartWindows() {
  if (!glfwInit()) {
    const char* why = nullptr;
    glfwGetError(&why);
    return why ? why : "glfwInit failed";
  }
  glfwWindowHint(GLFW_CLIENT_API, GLFW_NO_API);
  glfwWindowHint(GLFW_FOCUSED, GLFW_FALSE);
  return "";
}

void EndWindows() { glfwTerminate(); }

void* NativeDisplay() { return glfwGetX11Display(); }

std::string TakeXErrors() {
  if (Display* display = glfwGetX11Display()) XSync(display, False);
  return std::exchange(xErrors, "");
}

Window::Window(uint32_t width, uint32_t height, int x, int y) {
  window_ = glfwCreateWindow(static_cast<int>(width), static_cast<int>(height), "rhi", nullptr, nullptr);
  if (!window_) throw std::runtime_error("GLFW makes no window");
  glfwSetWindowPos(window_, x, y);
  XSetErrorHandler(OnXError);  // GLFW sets the default back while it makes a window
  Sync();
}

void* Window::Native() const { return reinterpret_cast<void*>(static_cast<uintptr_t>(glfwGetX11Window(window_))); }

void Window::SetSize(uint32_t width, uint32_t height) {
  glfwSetWindowSize(window_, static_cast<int>(width), static_cast<int>(height));
  Sync();
}

void Window::Iconify() {
  glfwIconifyWindow(window_);
  XUnmapWindow(glfwGetX11Display(), glfwGetX11Window(window_));  // what a window manager would do
  Sync();
}

void Window::Restore() {
  XMapWindow(glfwGetX11Display(), glfwGetX11Window(window_));
  glfwRestoreWindow(window_);
  Sync();
}

void Window::Destroy() {
  if (window_) glfwDestroyWindow(window_);
  window_ = nullptr;
  XSync(glfwGetX11Display(), False);
}

Pixels Window::Shot() const {
  Display* display = glfwGetX11Display();
  XSync(display, False);
  XWindowAttributes at{};
  XGetWindowAttributes(display, glfwGetX11Window(window_), &at);
  Pixels p{static_cast<uint32_t>(at.width), static_cast<uint32_t>(at.height), {}};
  XImage* image = XGetImage(display, glfwGetX11Window(window_), 0, 0, p.width, p.height, AllPlanes, ZPixmap);
  if (!image) throw std::runtime_error("XGetImage gives no picture of the window");
  for (int y = 0; y < at.height; ++y)
    for (int x = 0; x < at.width; ++x) {
      const unsigned long pixel = XGetPixel(image, x, y);
      for (const unsigned long mask : {image->red_mask, image->green_mask, image->blue_mask})
        p.rgb.push_back(Channel(pixel, mask));
    }
  XDestroyImage(image);
  return p;
}

}  // namespace rhi_test
