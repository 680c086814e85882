// A picture of time against error, as SVG.
#pragma once

#include <string>
#include <vector>

namespace app {

struct PlotPoint {
  std::string label;
  double ms = 0, error = 0;
  size_t series = 0;  // index into the plot's series
  bool onFront = false, isDefault = false, isBaseline = false;
};

struct Plot {
  std::string title;
  std::vector<std::string> series;
  std::vector<PlotPoint> points;
};

// Both axes are logarithmic; one front for each series. Classes, not colours: the page
// has both a light and a dark style. No two labels overlap.
std::string PlotSvg(const Plot&);

}  // namespace app
