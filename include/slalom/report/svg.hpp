#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace slalom::report {

/// A point of a picture; unit: 1/72 inch, x right, y down.
struct Point {
  double x = 0, y = 0;
};

/// How a shape is drawn. Empty colours draw nothing.
struct Stroke {
  std::string colour;
  double width = 0.8;     ///< [1/72 inch]
  std::string dash = {};  ///< as stroke-dasharray, e.g. "3 2"; empty: solid
  double opacity = 1;
};
struct Fill {
  std::string colour;
  double opacity = 1;
};
struct Font {
  double size = 7;                    ///< [1/72 inch]
  std::string_view anchor = "start";  ///< start, middle, end
  std::string colour = "#17212c";
  bool bold = false;
  double rotate = 0;  ///< about the text's point [deg], counter-clockwise
  bool halo = false;  ///< on white, to be read across lines
};

/// A small SVG document, fit for print: sizes in points, fonts by generic family, no script, no
/// style sheet. Coordinates that are not finite are left out, so that the result is always valid.
class Svg {
 public:
  /// `name` keeps this document's ids apart from those of others on the same page.
  Svg(const std::string& name, double width, double height, std::string title);

  void line(Point a, Point b, const Stroke& stroke);
  /// Breaks at points that are not finite; those that cannot be told from a straight line are left
  /// out.
  void polyline(const std::vector<Point>& points, const Stroke& stroke);
  void polygon(const std::vector<Point>& points, const Fill& fill, const Stroke& stroke = {});
  void rect(Point corner, double width, double height, const Fill& fill, const Stroke& stroke = {});
  void ellipse(Point centre, double rx, double ry, const Fill& fill, const Stroke& stroke = {});
  /// What follows carries data-mark="mark", by which a page knows it, until end_mark().
  void begin_mark(std::string_view mark);
  void end_mark();
  void text(Point at, std::string_view text, const Font& font);

  /// What follows is clipped to a rectangle, until end_clip().
  void begin_clip(Point corner, double width, double height);
  void end_clip();

  double width() const { return width_; }
  double height() const { return height_; }
  /// The whole document, with XML declaration.
  std::string str() const;

 private:
  std::string name_, title_, body_;
  double width_, height_;
  int clips_ = 0;
};

/// Documents made by Svg beside each other, tops aligned, `gap` apart; each keeps its size.
std::string side_by_side(const std::string& title, const std::vector<std::string>& documents,
                         double gap);

/// Okabe and Ito's palette, told apart by colour-blind readers and in grey.
namespace colours {
inline constexpr const char* ink = "#17212c";
inline constexpr const char* muted = "#5a6673";
inline constexpr const char* grid = "#e3e7ec";
inline constexpr const char* blue = "#0072b2";
inline constexpr const char* vermilion = "#d55e00";
inline constexpr const char* green = "#009e73";
inline constexpr const char* orange = "#e69f00";
inline constexpr const char* sky = "#56b4e9";
inline constexpr const char* purple = "#cc79a7";
}  // namespace colours

}  // namespace slalom::report
