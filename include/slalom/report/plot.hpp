#pragma once

#include <limits>
#include <string>
#include <vector>

#include "slalom/report/svg.hpp"

namespace slalom::report {

/// Ticks of an axis: multiples of 1, 2 or 5 times a power of ten within [lo, hi].
struct Ticks {
  double step = 1;
  std::vector<double> at;
  /// Decimals that tell them apart.
  int digits() const;
};
/// About `count` ticks; lo <= hi, both finite.
Ticks nice_ticks(double lo, double hi, int count);

/// One line of a plot. Points that are not finite break it.
struct Series {
  std::string label;  ///< in the legend; empty: not there
  std::vector<double> x, y;
  Stroke stroke;
  bool markers = false;
  bool hollow = false;  ///< markers are rings
  bool line = true;     ///< false: markers alone
  double size = 1;      ///< of the markers, as a multiple of their usual one
  std::vector<std::string> marks =
      {};  ///< what each marker stands for (Svg::begin_mark); may be empty
};

/// A level drawn across a plot, such as a limit.
struct Level {
  double y = 0;
  std::string label;
  Stroke stroke = {colours::muted, 0.7, "3 2", 1};
  bool label_left = false;
};

/// A plot with its axes. Ranges left as NaN follow the data; levels far outside the data are not
/// drawn.
struct Plot {
  std::string x_label, y_label;
  std::vector<Series> series = {};
  std::vector<Level> levels = {};
  double x_min = std::numeric_limits<double>::quiet_NaN();
  double x_max = std::numeric_limits<double>::quiet_NaN();
  double y_min = std::numeric_limits<double>::quiet_NaN();
  double y_max = std::numeric_limits<double>::quiet_NaN();
  bool log_y = false;
  bool x_tick_labels = true;
};

/// 8 cm, the width of a column [1/72 inch].
inline constexpr double kColumnWidth = 8 / 2.54 * 72;

/// Draws `plot` into the rectangle at `corner` (axes' labels included).
void draw_plot(Svg& svg, const Plot& plot, Point corner, double width, double height);

/// One plot as a picture of a column's width, its legend above it.
std::string plot_svg(const std::string& name, const std::string& title, const Plot& plot,
                     double height = 150);

/// Plots one below the other with one legend: all labels of the first plot.
std::string stacked_svg(const std::string& name, const std::string& title,
                        const std::vector<Plot>& plots, double height_each = 100);

/// A legend in one row or more of `width`; returns its height.
double draw_legend(Svg& svg, const std::vector<Series>& series, Point corner, double width);

}  // namespace slalom::report
