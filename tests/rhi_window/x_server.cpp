#include "x_server.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>

namespace rhi_test {
namespace {

constexpr int kStartSeconds = 30;

// In the child. The server picks a free display and writes its number to `fd`.
[[noreturn]] void RunServer(int fd) {
  prctl(PR_SET_PDEATHSIG, SIGTERM);  // no server is left behind, however the test ends
  const int quiet = open("/dev/null", O_RDWR);
  dup2(quiet, STDOUT_FILENO);
  dup2(quiet, STDERR_FILENO);
  const std::string number = std::to_string(fd);
  execlp("Xvfb", "Xvfb", "-displayfd", number.c_str(), "-screen", "0", "1024x768x24", "-nolisten", "tcp", "-noreset",
         static_cast<char*>(nullptr));
  _exit(127);
}

// The first line that comes out of `fd`, or what came until the end or the deadline.
std::string ReadLine(int fd) {
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(kStartSeconds);
  std::string line;
  while (std::chrono::steady_clock::now() < deadline) {
    pollfd p{fd, POLLIN, 0};
    if (poll(&p, 1, 100) <= 0) continue;
    char c = 0;
    if (read(fd, &c, 1) != 1) return "";
    if (c == '\n') return line;
    line += c;
  }
  return "";
}

}  // namespace

std::string XServer::Start() {
  int ends[2];
  if (pipe(ends) != 0) return "no pipe";
  process_ = fork();
  if (process_ == 0) {
    close(ends[0]);
    RunServer(ends[1]);
  }
  close(ends[1]);
  const std::string number = process_ > 0 ? ReadLine(ends[0]) : "";
  close(ends[0]);
  if (number.empty()) {
    Stop();
    return "Xvfb does not start; is the package xvfb (tools/packages.txt) installed?";
  }
  setenv("DISPLAY", (":" + number).c_str(), 1);
  return "";
}

void XServer::Stop() {
  if (process_ <= 0) return;
  kill(process_, SIGTERM);
  waitpid(process_, nullptr, 0);
  process_ = -1;
}

}  // namespace rhi_test
