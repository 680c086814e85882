#include "machine.h"

#include <sys/utsname.h>

#include <chrono>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <iterator>
#include <thread>

namespace app {
namespace {

std::string ModelOfCpu() {
  std::ifstream in("/proc/cpuinfo");
  for (std::string line; std::getline(in, line);)
    if (line.rfind("model name", 0) == 0 && line.find(": ") != std::string::npos)
      return line.substr(line.find(": ") + 2);
  return "unknown";
}

// As typed, but for quotes.
std::string CommandLine() {
  std::ifstream in("/proc/self/cmdline", std::ios::binary);
  std::string text{std::istreambuf_iterator<char>(in), {}};
  while (!text.empty() && text.back() == '\0') text.pop_back();
  for (char& c : text)
    if (c == '\0') c = ' ';
  return text;
}

std::string Utc() {
  const std::time_t now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
  std::tm utc{};
  char text[32] = "";
  if (gmtime_r(&now, &utc)) std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &utc);
  return text;
}

}  // namespace

Machine DescribeMachine() {
  utsname name{};
  uname(&name);
  Machine m;
  m.host = name.nodename;
  m.system = std::string(name.sysname) + " " + name.release + " " + name.machine;
  m.cpu = ModelOfCpu();
  m.cores = std::thread::hardware_concurrency();
  m.build = FUR_BUILD_TYPE;
  m.compiler = "g++ " __VERSION__;
  m.version = FUR_VERSION;
  m.date = Utc();
  m.command = CommandLine();
  return m;
}

bool IsBusy(const Machine& m, double load) { return load > 0.25 * m.cores; }

double LoadAverage() {
  double load = -1;
  return getloadavg(&load, 1) == 1 ? load : -1;
}

}  // namespace app
