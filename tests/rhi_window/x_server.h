// An Xvfb of this process alone: a display server without a screen. It ends with the object, and with the process.
#pragma once

#include <sys/types.h>

#include <string>

namespace rhi_test {

class XServer {
 public:
  XServer() = default;
  XServer(const XServer&) = delete;
  XServer& operator=(const XServer&) = delete;
  ~XServer() { Stop(); }

  // Sets DISPLAY. Empty, or why there is no server.
  std::string Start();
  void Stop();

 private:
  pid_t process_ = -1;
};

}  // namespace rhi_test
