#include "slalom/report/plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "html.hpp"

namespace slalom::report {
namespace {

constexpr double kFont = 7;  ///< labels
constexpr double kTickFont = 6.5;
constexpr double kLeft = 30, kRight = 6, kTop = 5;
constexpr double kTickRow = 10, kLabelRow = 11;

struct Range {
  double lo = std::numeric_limits<double>::infinity();
  double hi = -std::numeric_limits<double>::infinity();
  void add(double v) {
    if (!std::isfinite(v)) return;
    lo = std::min(lo, v);
    hi = std::max(hi, v);
  }
  bool empty() const { return !(lo <= hi); }
};

/// The axes of one plot in its frame.
struct Frame {
  Point corner;          ///< of the area inside the axes
  double width, height;  ///< of that area
  Range x, y;
  bool log_y;

  double px(double v) const { return corner.x + width * (v - x.lo) / (x.hi - x.lo); }
  double py(double v) const {
    const double w =
        log_y ? std::log(v / y.lo) / std::log(y.hi / y.lo) : (v - y.lo) / (y.hi - y.lo);
    return corner.y + height * (1 - w);
  }
};

Range x_range(const Plot& plot) {
  Range range;
  for (const auto& series : plot.series)
    for (const double v : series.x) range.add(v);
  if (std::isfinite(plot.x_min)) range.lo = plot.x_min;
  if (std::isfinite(plot.x_max)) range.hi = plot.x_max;
  if (range.empty()) range = {0, 1};
  if (range.hi - range.lo < 1e-9) range.hi = range.lo + 1;
  return range;
}

Range y_range(const Plot& plot) {
  Range range;
  for (const auto& series : plot.series)
    for (const double v : series.y)
      if (!plot.log_y || v > 0) range.add(v);
  if (range.empty()) range = {plot.log_y ? 0.1 : 0.0, 1};
  const double span = std::max(range.hi - range.lo, 1e-6);
  const Range data = range;
  for (const auto& level : plot.levels) {
    if (plot.log_y && level.y <= 0) continue;
    if (plot.log_y || (level.y < data.hi + 0.6 * span && level.y > data.lo - 0.6 * span))
      range.add(level.y);
  }
  if (plot.log_y) {
    range.lo /= 1.5;
    range.hi *= 1.6;
  } else {
    // What is constant but for rounding gets a scale of its own size.
    const double least = std::max(1e-6, 0.02 * std::max(std::abs(range.lo), std::abs(range.hi)));
    const double pad = range.hi - range.lo < 1e-4 * least ? least : 0.07 * (range.hi - range.lo);
    range.lo -= pad;
    range.hi += pad;
  }
  if (std::isfinite(plot.y_min)) range.lo = plot.y_min;
  if (std::isfinite(plot.y_max)) range.hi = plot.y_max;
  if (!(range.hi > range.lo)) range.hi = range.lo + 1;
  return range;
}

Ticks ticks_of(double lo, double hi, int count) {
  Ticks ticks;
  const double raw = (hi - lo) / std::max(count, 1);
  if (!(raw > 0) || !std::isfinite(raw)) {
    ticks.at = {lo};
    return ticks;
  }
  const double power = std::pow(10.0, std::floor(std::log10(raw)));
  for (const double m : {1.0, 2.0, 5.0, 10.0}) {
    ticks.step = m * power;
    if (ticks.step >= raw * 0.999) break;
  }
  const double first = std::ceil(lo / ticks.step - 1e-9);
  for (double i = first; i * ticks.step <= hi + 1e-9 * ticks.step; ++i)
    ticks.at.push_back(i * ticks.step);
  return ticks;
}

std::vector<double> log_ticks(const Range& range) {
  std::vector<double> at;
  const bool many = range.hi / range.lo < 60;
  for (double power = std::floor(std::log10(range.lo)); power <= std::log10(range.hi); ++power)
    for (const double m : {1.0, 2.0, 5.0}) {
      const double v = m * std::pow(10.0, power);
      if ((many || m == 1) && v >= range.lo && v <= range.hi) at.push_back(v);
    }
  return at;
}

void draw_y_axis(Svg& svg, const Plot& plot, const Frame& frame) {
  const auto ticks = nice_ticks(frame.y.lo, frame.y.hi, std::max(2, int(frame.height / 22)));
  for (const double v : plot.log_y ? log_ticks(frame.y) : ticks.at) {
    const double y = frame.py(v);
    svg.line({frame.corner.x, y}, {frame.corner.x + frame.width, y}, {colours::grid, 0.5, "", 1});
    svg.text({frame.corner.x - 3, y + 2.3},
             plot.log_y ? fmt::format("{:g}", v) : number(v, ticks.digits()), {kTickFont, "end"});
  }
  svg.text({frame.corner.x - kLeft + 7, frame.corner.y + frame.height / 2}, plot.y_label,
           {kFont, "middle", colours::ink, false, 90});
}

void draw_x_axis(Svg& svg, const Plot& plot, const Frame& frame) {
  const auto ticks = nice_ticks(frame.x.lo, frame.x.hi, std::max(2, int(frame.width / 32)));
  const double bottom = frame.corner.y + frame.height;
  for (const double v : ticks.at) {
    svg.line({frame.px(v), frame.corner.y}, {frame.px(v), bottom}, {colours::grid, 0.5, "", 1});
    if (!plot.x_tick_labels) continue;
    const auto label = number(v, ticks.digits());
    const double half = 0.32 * kTickFont * static_cast<double>(label.size());
    const double most = frame.corner.x + frame.width + kRight - half;
    svg.text({std::min(frame.px(v), most), bottom + 8.5}, label, {kTickFont, "middle"});
  }
  if (plot.x_tick_labels)
    svg.text({frame.corner.x + frame.width / 2, bottom + kTickRow + 7.5}, plot.x_label,
             {kFont, "middle"});
}

void draw_levels(Svg& svg, const Plot& plot, const Frame& frame) {
  for (const auto& level : plot.levels) {
    if (level.y < frame.y.lo || level.y > frame.y.hi) continue;
    const double y = frame.py(level.y);
    const double right = frame.corner.x + frame.width;
    svg.line({frame.corner.x, y}, {right, y}, level.stroke);
    if (level.label.empty()) continue;
    const double ty = y - frame.corner.y < 9 ? y + 6.5 : y - 2;
    if (level.label_left)
      svg.text({frame.corner.x + 2, ty}, level.label, {6, "start", colours::muted});
    else
      svg.text({right - 2, ty}, level.label, {6, "end", colours::muted});
  }
}

void draw_marker(Svg& svg, Point at, const Series& series) {
  if (series.hollow)
    svg.ellipse(at, 2 * series.size, 2 * series.size, {"#ffffff", 1},
                {series.stroke.colour, 0.9, "", 1});
  else
    svg.ellipse(at, 1.4 * series.size, 1.4 * series.size, {series.stroke.colour, 1});
}

void draw_series(Svg& svg, const Plot& plot, const Frame& frame) {
  svg.begin_clip({frame.corner.x, frame.corner.y - 1}, frame.width + 1, frame.height + 2);
  for (const auto& series : plot.series) {
    std::vector<Point> points;
    const auto n = std::min(series.x.size(), series.y.size());
    for (std::size_t i = 0; i < n; ++i)
      points.push_back({frame.px(series.x[i]), frame.py(series.y[i])});
    if (series.line) svg.polyline(points, series.stroke);
    if (!series.markers) continue;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const bool marked = i < series.marks.size();
      if (marked) svg.begin_mark(series.marks[i]);
      draw_marker(svg, points[i], series);
      if (marked) svg.end_mark();
    }
  }
  svg.end_clip();
}

}  // namespace

int Ticks::digits() const {
  return std::max(0, -static_cast<int>(std::floor(std::log10(step) + 1e-9)));
}

Ticks nice_ticks(double lo, double hi, int count) {
  auto ticks = ticks_of(lo, hi, count);
  // One tick is no scale.
  for (int more = count + 1; count > 1 && ticks.at.size() < 2 && more <= 3 * count; ++more)
    ticks = ticks_of(lo, hi, more);
  return ticks;
}

void draw_plot(Svg& svg, const Plot& plot, Point corner, double width, double height) {
  const double below = plot.x_tick_labels ? kTickRow + kLabelRow : 3;
  const Frame frame{{corner.x + kLeft, corner.y + kTop},
                    width - kLeft - kRight,
                    height - kTop - below,
                    x_range(plot),
                    y_range(plot),
                    plot.log_y};
  draw_y_axis(svg, plot, frame);
  draw_x_axis(svg, plot, frame);
  draw_levels(svg, plot, frame);
  draw_series(svg, plot, frame);
  svg.rect(frame.corner, frame.width, frame.height, {}, {colours::muted, 0.6, "", 1});
}

double draw_legend(Svg& svg, const std::vector<Series>& series, Point corner, double width) {
  double x = corner.x, y = corner.y + 8, height = 0;
  for (const auto& one : series) {
    if (one.label.empty()) continue;
    // Helvetica's mean advance is half the font's size.
    const double advance = 20 + 0.52 * kFont * static_cast<double>(one.label.size());
    if (x > corner.x && x + advance > corner.x + width) {
      x = corner.x;
      y += 10;
    }
    if (one.line) svg.line({x, y - 2.4}, {x + 12, y - 2.4}, one.stroke);
    if (one.markers) draw_marker(svg, {x + 6, y - 2.4}, one);
    svg.text({x + 15, y}, one.label, {kFont, "start"});
    x += advance + 4;
    height = y - corner.y + 4;
  }
  return height;
}

std::string plot_svg(const std::string& name, const std::string& title, const Plot& plot,
                     double height) {
  return stacked_svg(name, title, {plot}, height);
}

std::string stacked_svg(const std::string& name, const std::string& title,
                        const std::vector<Plot>& plots, double height_each) {
  // The legend's height is known once it has been laid out.
  Svg trial(name, kColumnWidth, 0, title);
  const auto& labelled = plots.empty() ? std::vector<Series>{} : plots.front().series;
  const double legend = draw_legend(trial, labelled, {kLeft, 0}, kColumnWidth - kLeft - kRight);
  Svg svg(name, kColumnWidth, legend + height_each * static_cast<double>(plots.size()), title);
  svg.rect({0, 0}, svg.width(), svg.height(), {"#ffffff", 1});
  draw_legend(svg, labelled, {kLeft, 0}, kColumnWidth - kLeft - kRight);
  double y = legend;
  for (const auto& plot : plots) {
    draw_plot(svg, plot, {0, y}, kColumnWidth, height_each);
    y += height_each;
  }
  return svg.str();
}

}  // namespace slalom::report
