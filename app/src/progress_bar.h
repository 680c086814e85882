// How far long work is.
#pragma once

#include <string>

namespace app {

// One line on stderr that is written over; nothing remains of it. Shown on a terminal, or where it is forced.
class ProgressBar {
 public:
  explicit ProgressBar(bool forced = false);
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;
  void Show(const std::string& what, double share);

 private:
  bool shown_;
  int last_ = -1;
  std::string what_;
};

}  // namespace app
