#pragma once

#include <limits>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "slalom/report/svg.hpp"

namespace slalom::report {

/// A rectangle of the plane [m].
struct Box {
  double x0 = std::numeric_limits<double>::infinity();
  double x1 = -std::numeric_limits<double>::infinity();
  double y0 = std::numeric_limits<double>::infinity();
  double y1 = -std::numeric_limits<double>::infinity();
  void add(double x, double y, double rx, double ry);
};

/// A rectangle of the plane on paper. Lying: y runs to the right and x downwards, which is the
/// upright map turned by a right angle.
struct View {
  Box box;
  Point corner;
  double scale = 1;  ///< [1/72 inch per m]
  bool lying = false;

  double width() const { return scale * (lying ? box.y1 - box.y0 : box.x1 - box.x0); }
  double height() const { return scale * (lying ? box.x1 - box.x0 : box.y1 - box.y0); }
  Point at(double x, double y) const {
    if (lying) return {corner.x + scale * (y - box.y0), corner.y + scale * (x - box.x0)};
    return {corner.x + scale * (x - box.x0), corner.y + scale * (box.y1 - y)};
  }
  bool shows(double x, double y) const {
    return x >= box.x0 && x <= box.x1 && y >= box.y0 && y <= box.y1;
  }
};

/// A place for words: the left, middle or right of their base line, as the anchor says.
using Place = std::pair<Point, std::string_view>;

/// What the labels of an axis from lo to hi [m] leave out, to be said once: zero, but the nearest
/// round number where places are so far from zero that labels would be all digits. As offset() of
/// viewer/drive_model.js.
double axis_offset(double lo, double hi);
/// "x [m]", or with an offset "x [m] +5e5".
std::string axis_label(const std::string& name, double offset);

/// Puts words on a map where there is still room for them.
class Labels {
 public:
  static constexpr double kSize = 6;  ///< of the letters [1/72 inch]

  Labels(Svg& svg, const View& view) : svg_(svg), view_(view) {}

  /// Room that words must leave free.
  void keep_clear(Point centre, double rx, double ry);
  /// Writes at the first free one of these places; nowhere, and false, if none is free.
  bool place(const std::string& text, const std::string& colour, const std::vector<Place>& places);

 private:
  bool free(const Box& box) const;

  Svg& svg_;
  const View& view_;
  std::vector<Box> taken_;
};

}  // namespace slalom::report
