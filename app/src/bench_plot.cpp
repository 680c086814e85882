#include "bench_plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "html_text.h"

namespace app {
namespace {

constexpr double kWidth = 640, kHeight = 420, kLeft = 56, kRight = 20, kTop = 34, kBottom = 62;
constexpr double kLetter = 6.6, kLine = 13;  // of the labels' font, on the safe side
constexpr double kRadius = 4.5;

struct Box {
  double x0, y0, x1, y1;
  bool Meets(const Box& o) const { return x0 < o.x1 && o.x0 < x1 && y0 < o.y1 && o.y0 < y1; }
};

struct Axes {
  double xLow, xHigh, yLow, yHigh;  // logarithms
  double X(double ms) const { return kLeft + (std::log10(ms) - xLow) / (xHigh - xLow) * (kWidth - kLeft - kRight); }
  double Y(double error) const {
    return kHeight - kBottom - (std::log10(error) - yLow) / (yHigh - yLow) * (kHeight - kTop - kBottom);
  }
};

double Positive(double v) { return std::isfinite(v) && v > 1e-6 ? v : 1e-6; }

Axes AxesFor(const Plot& plot) {
  Axes a{1e9, -1e9, 1e9, -1e9};
  for (const PlotPoint& p : plot.points) {
    const double x = std::log10(Positive(p.ms)), y = std::log10(Positive(p.error));
    a = {std::min(a.xLow, x), std::max(a.xHigh, x), std::min(a.yLow, y), std::max(a.yHigh, y)};
  }
  return {a.xLow - 0.1, a.xHigh + 0.2, a.yLow - 0.1, a.yHigh + 0.1};  // room for labels
}

// Round values between two logarithms, as many as there is room for: `at` gives their places.
template <class At>
std::vector<double> Ticks(double low, double high, double apart, const At& at) {
  std::vector<double> ticks;
  for (int power = int(std::floor(low)); power <= int(std::floor(high)); ++power)
    for (const double m : {1.0, 1.2, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 7.0}) {
      const double value = m * std::pow(10, power), log = std::log10(value);
      const bool room = ticks.empty() || std::abs(at(value) - at(ticks.back())) >= apart;
      if (log >= low && log <= high && room) ticks.push_back(value);
    }
  return ticks;
}

std::string Line(const char* kind, double x0, double y0, double x1, double y1) {
  return fmt::format("<line class=\"{}\" x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\"/>", kind, x0, y0, x1,
                     y1);
}

std::string Text(const char* kind, const char* anchor, double x, double y, const std::string& text) {
  return fmt::format("<text class=\"{}\" x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\">{}</text>", kind, x, y, anchor,
                     Escaped(text));
}

std::string Grid(const Axes& a) {
  std::string svg;
  for (const double e : Ticks(a.yLow, a.yHigh, 24, [&](double v) { return a.Y(v); }))
    svg += Line("grid", kLeft, a.Y(e), kWidth - kRight, a.Y(e)) +
           Text("tick", "end", kLeft - 6, a.Y(e) + 4, fmt::format("{:.3g}", e));
  for (const double ms : Ticks(a.xLow, a.xHigh, 36, [&](double v) { return a.X(v); }))
    svg += Line("grid", a.X(ms), kTop, a.X(ms), kHeight - kBottom) +
           Text("tick", "middle", a.X(ms), kHeight - kBottom + 16, fmt::format("{:.4g}", ms));
  svg += Text("axis", "end", kWidth - kRight, kHeight - kBottom + 32, "ms a frame (log)");
  return svg + Text("axis", "start", 4, kTop - 18, "mean FLIP in the mask (log)");
}

// Corners of a step line: between two points of a front nothing better was measured than the left one's error.
std::vector<std::pair<double, double>> FrontOf(const Plot& plot, size_t series, const Axes& a) {
  std::vector<PlotPoint> front;
  for (const PlotPoint& p : plot.points)
    if (p.series == series && p.onFront) front.push_back(p);
  std::sort(front.begin(), front.end(), [](const PlotPoint& l, const PlotPoint& r) { return l.ms < r.ms; });
  std::vector<std::pair<double, double>> corners;
  for (const PlotPoint& p : front) {
    const double x = a.X(Positive(p.ms)), y = a.Y(Positive(p.error));
    if (!corners.empty()) corners.emplace_back(x, corners.back().second);
    corners.emplace_back(x, y);
  }
  return corners;
}

std::string Front(const Plot& plot, size_t series, const Axes& a) {
  std::string path;
  for (const auto& [x, y] : FrontOf(plot, series, a))
    path += fmt::format("{}{:.1f} {:.1f}", path.empty() ? "M" : "L", x, y);
  return path.empty() ? "" : fmt::format("<path class=\"front s{}\" d=\"{}\"/>", series, path);
}

std::string Mark(const PlotPoint& p, double x, double y) {
  const std::string title = fmt::format("<title>{}: {:.3g} ms, FLIP {:.4f}</title>", Escaped(p.label), p.ms, p.error);
  const std::string style = fmt::format("class=\"point s{}{}\"", p.series, p.onFront ? "" : " hollow");
  if (p.isBaseline)
    return fmt::format("<rect {} x=\"{:.1f}\" y=\"{:.1f}\" width=\"9\" height=\"9\">{}</rect>", style, x - 4.5, y - 4.5,
                       title);
  const std::string ring =
      p.isDefault ? fmt::format("<circle class=\"ring s{}\" cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"8\"/>", p.series, x, y)
                  : "";
  return ring + fmt::format("<circle {} cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{}\">{}</circle>", style, x, y, kRadius, title);
}

bool IsFree(const Box& box, const std::vector<Box>& taken) {
  const bool inside = box.x0 >= kLeft && box.x1 <= kWidth - 2 && box.y0 >= kTop - 8 && box.y1 <= kHeight - kBottom - 2;
  return inside && std::none_of(taken.begin(), taken.end(), [&](const Box& t) { return box.Meets(t); });
}

// Beside its point, or as near as there is room; then a line leads to it.
Box PlaceLabel(double x, double y, double width, const std::vector<Box>& taken) {
  Box box{};
  for (double distance = 9; distance < 400; distance += 6)
    for (const double angle : {0.0, 180.0, -30.0, 30.0, -150.0, 150.0, -60.0, 60.0, -120.0, 120.0, -90.0, 90.0}) {
      const double dx = std::cos(angle * 3.14159265358979 / 180) * distance,
                   dy = std::sin(angle * 3.14159265358979 / 180) * distance;
      const double left = std::abs(dx) < 1 ? x - width / 2 : dx > 0 ? x + dx : x + dx - width;
      box = {left, y + dy - kLine / 2, left + width, y + dy + kLine / 2};
      if (IsFree(box, taken)) return box;
    }
  return box;
}

// Where no label may be: the points and the fronts.
std::vector<Box> Taken(const Plot& plot, const Axes& a) {
  std::vector<Box> taken;
  for (const PlotPoint& p : plot.points) {
    const double x = a.X(Positive(p.ms)), y = a.Y(Positive(p.error)), r = p.isDefault ? 9 : kRadius + 1;
    taken.push_back({x - r, y - r, x + r, y + r});
  }
  for (size_t series = 0; series < plot.series.size(); ++series) {
    const auto corners = FrontOf(plot, series, a);
    for (size_t i = 0; i + 1 < corners.size(); ++i) {
      const auto [x0, x1] = std::minmax(corners[i].first, corners[i + 1].first);
      const auto [y0, y1] = std::minmax(corners[i].second, corners[i + 1].second);
      taken.push_back({x0 - 1, y0 - 1, x1 + 1, y1 + 1});
    }
  }
  return taken;
}

std::string Labels(const Plot& plot, const Axes& a) {
  std::vector<Box> taken = Taken(plot, a);
  std::string svg;
  for (const PlotPoint& p : plot.points) {
    const double x = a.X(Positive(p.ms)), y = a.Y(Positive(p.error));
    const Box box = PlaceLabel(x, y, kLetter * double(p.label.size()), taken);
    taken.push_back(box);
    const double nearX = std::clamp(x, box.x0, box.x1), nearY = std::clamp(y, box.y0, box.y1);
    if (std::hypot(nearX - x, nearY - y) > 14) svg += Line("leader", x, y, nearX, nearY);
    svg += Text("label", "middle", (box.x0 + box.x1) / 2, box.y1 - 3, p.label);
  }
  return svg;
}

std::string Legend(const Plot& plot) {
  std::string svg;
  double x = kLeft;
  for (size_t i = 0; i < plot.series.size(); ++i) {
    svg += fmt::format("<circle class=\"point s{}\" cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{}\"/>", i, x + 5, kHeight - 14,
                       kRadius);
    svg += Text("axis", "start", x + 14, kHeight - 10, plot.series[i]);
    x += 34 + kLetter * double(plot.series[i].size());
  }
  return svg;
}

}  // namespace

std::string PlotSvg(const Plot& plot) {
  const Axes a = AxesFor(plot);
  std::string svg = fmt::format("<svg class=\"plot\" viewBox=\"0 0 {} {}\" role=\"img\" aria-label=\"{}\">", kWidth,
                                kHeight, Escaped(plot.title));
  svg += Text("title", "middle", kWidth / 2, 16, plot.title) + Grid(a);
  for (size_t i = 0; i < plot.series.size(); ++i) svg += Front(plot, i, a);
  svg += Labels(plot, a);
  for (const PlotPoint& p : plot.points) svg += Mark(p, a.X(Positive(p.ms)), a.Y(Positive(p.error)));
  return svg + Legend(plot) + "</svg>\n";
}

}  // namespace app
