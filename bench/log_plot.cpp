#include "bench/log_plot.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace curveskel::bench {
namespace {

constexpr double left = 80;
constexpr double right = 540;
constexpr double top = 40;
constexpr double bottom = 420;

struct Axis {
  double low = 1e300;  // log10
  double high = -1e300;
  double from = 0;  // pixels
  double to = 1;

  void include(double value) {
    low = std::min(low, std::log10(value));
    high = std::max(high, std::log10(value));
  }
  void widen() {
    low = std::floor(low - 0.05);
    high = std::ceil(high + 0.05);
  }
  [[nodiscard]] double at(double value) const {
    return from + (std::log10(value) - low) / (high - low) * (to - from);
  }
};

// Colours that are told apart in print and by colour-blind readers (Okabe and Ito 2008), and dashes
// for the second round through them.
constexpr std::array<const char*, 7> colours{"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                             "#e69f00", "#56b4e9", "#000000"};

std::string grid(const Axis& x, const Axis& y) {
  std::string svg;
  for (double e = y.low; e <= y.high + 0.5; ++e) {
    const double at = y.at(std::pow(10, e));
    svg += fmt::format(
        "<line x1='{}' x2='{}' y1='{:.1f}' y2='{:.1f}' stroke='#ddd'/>"
        "<text x='{}' y='{:.1f}' text-anchor='end'>10<tspan dy='-5' font-size='9'>{:.0f}</tspan>"
        "</text>\n",
        left, right, at, at, left - 8, at + 4, e);
  }
  for (double e = x.low; e <= x.high + 0.5; ++e) {
    const double at = x.at(std::pow(10, e));
    svg += fmt::format(
        "<line y1='{}' y2='{}' x1='{:.1f}' x2='{:.1f}' stroke='#ddd'/>"
        "<text x='{:.1f}' y='{}' text-anchor='middle'>{:.0f}</text>\n",
        top, bottom, at, at, at, bottom + 18, std::pow(10, e));
  }
  return svg;
}

std::string curve(const Series& series, const Axis& x, const Axis& y, std::size_t index) {
  const std::size_t of = series.beside < 0 ? index : static_cast<std::size_t>(series.beside);
  const char* const colour = colours[of % colours.size()];
  const bool first_round = of < colours.size();
  const char* const dash =
      series.other ? (first_round ? "1 3" : "5 3 1 3") : (first_round ? "none" : "5 3");
  std::string points;
  std::string marks;
  for (std::size_t i = 0; i < series.x.size(); ++i) {
    points += fmt::format("{:.1f},{:.1f} ", x.at(series.x[i]), y.at(series.y[i]));
    if (series.other) {
      marks +=
          fmt::format("<rect x='{:.1f}' y='{:.1f}' width='8' height='8' stroke='{}' fill='#fff'/>",
                      x.at(series.x[i]) - 4, y.at(series.y[i]) - 4, colour);
      continue;
    }
    marks += fmt::format("<circle cx='{:.1f}' cy='{:.1f}' r='4' stroke='{}' fill='{}'/>",
                         x.at(series.x[i]), y.at(series.y[i]), colour,
                         series.predicted[i] ? "#fff" : colour);
  }
  const double label = top + 10 + 20 * static_cast<double>(index);
  return fmt::format(
      "<polyline points='{}' fill='none' stroke='{}' stroke-width='1.5' stroke-dasharray='{}'/>{}"
      "<line x1='{}' x2='{}' y1='{}' y2='{}' stroke='{}' stroke-width='2' stroke-dasharray='{}'/>"
      "<text x='{}' y='{}'>{}</text>\n",
      points, colour, dash, marks, right + 15, right + 40, label, label, colour, dash, right + 46,
      label + 4, series.name);
}

}  // namespace

std::string log_log_plot(const std::string& title, const std::string& x_name,
                         const std::string& y_name, const std::vector<Series>& series) {
  Axis x;
  x.from = left;
  x.to = right;
  Axis y;
  y.from = bottom;
  y.to = top;
  for (const Series& s : series) {
    for (std::size_t i = 0; i < s.x.size(); ++i) {
      x.include(s.x[i]);
      y.include(s.y[i]);
    }
  }
  x.widen();
  y.widen();
  std::string svg = fmt::format(
      "<svg xmlns='http://www.w3.org/2000/svg' width='760' height='480' font-family='sans-serif' "
      "font-size='12'>\n<rect width='760' height='480' fill='#fff'/>\n"
      "<text x='{}' y='22' font-size='15'>{}</text>\n",
      left, title);
  svg += grid(x, y);
  for (std::size_t i = 0; i < series.size(); ++i) svg += curve(series[i], x, y, i);
  const bool others =
      std::any_of(series.begin(), series.end(), [](const Series& s) { return s.other; });
  svg += fmt::format(
      "<text x='{}' y='{}' text-anchor='middle'>{}</text>\n"
      "<text transform='translate(20 {}) rotate(-90)' text-anchor='middle'>{}</text>\n"
      "<text x='{}' y='{}' fill='#666'>hollow{}: predicted</text>\n</svg>\n",
      (left + right) / 2, bottom + 40, x_name, (top + bottom) / 2, y_name, right + 15, bottom,
      others ? " circle" : "");
  return svg;
}

}  // namespace curveskel::bench
