// A GLFW window without an API, and pictures of what it shows. No header of X11 or GLFW is seen outside of window.cpp.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

struct GLFWwindow;

namespace rhi_test {

struct Pixels {
  uint32_t width = 0, height = 0;
  std::vector<uint8_t> rgb;  // tightly packed, row 0 on top
  bool operator==(const Pixels&) const = default;
};

std::string StartWindows();  // GLFW, on DISPLAY; empty, or why not
void EndWindows();
void* NativeDisplay();      // the X11 Display*
std::string TakeXErrors();  // errors of the X server since the last call, one a line
void WritePng(const std::string& path, const Pixels&);

class Window {
 public:
  // Windows that overlap would hide what they show from each other's pictures.
  Window(uint32_t width, uint32_t height, int x = 0, int y = 0);
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;
  ~Window() { Destroy(); }

  void* Native() const;                           // the X11 Window, for SwapChainDesc::nativeWindow
  void SetSize(uint32_t width, uint32_t height);  // returns when the server has done it
  void Iconify();
  void Restore();
  void Destroy();
  Pixels Shot() const;

 private:
  GLFWwindow* window_ = nullptr;
};

}  // namespace rhi_test
