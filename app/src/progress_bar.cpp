#include "progress_bar.h"

#include <fmt/format.h>
#include <unistd.h>

namespace app {
namespace {

constexpr int kWidth = 40, kWords = 32;

}  // namespace

ProgressBar::ProgressBar(bool forced) : shown_(forced || isatty(STDERR_FILENO) != 0) {}

ProgressBar::~ProgressBar() {
  if (shown_) fmt::print(stderr, "\r{:{}}\r", "", kWords + kWidth + 9);
}

void ProgressBar::Show(const std::string& what, double share) {
  const int percent = static_cast<int>(share * 100);
  if (!shown_ || (percent == last_ && what == what_)) return;
  last_ = percent;
  what_ = what;
  const int filled = percent * kWidth / 100;
  fmt::print(stderr, "\r{:<{}.{}} [{:=<{}}{:{}}] {:3} %", what, kWords, kWords, "", filled, "", kWidth - filled,
             percent);
  std::fflush(stderr);
}

}  // namespace app
