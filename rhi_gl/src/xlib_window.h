// Asks the X server about a window. Xlib's headers define macros like None, Status and Always: only xlib_window.cpp
// sees them, and it sees nothing of ours.
#pragma once

namespace rhi_gl {

struct XlibWindowInfo {
  unsigned width = 0, height = 0;
  unsigned long visual = 0;  // the VisualID; only QueryXlibWindow fills it in
};

// `display` is a Display*. False: there is no such window (any more). No X error handler of the program sees it, and
// Xlib's own, which would end the program, does not either.
bool QueryXlibWindow(void* display, unsigned long window, XlibWindowInfo* out);
bool QueryXlibSize(void* display, unsigned long window, XlibWindowInfo* out);  // one round trip

}  // namespace rhi_gl
