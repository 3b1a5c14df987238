#include "map_view.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace slalom::report {

void Box::add(double x, double y, double rx, double ry) {
  x0 = std::min(x0, x - rx);
  x1 = std::max(x1, x + rx);
  y0 = std::min(y0, y - ry);
  y1 = std::max(y1, y + ry);
}

double axis_offset(double lo, double hi) {
  const double length = std::max(hi - lo, 1.0);
  if (std::max(std::abs(lo), std::abs(hi)) < std::max(1e4, 20 * length)) return 0;
  const double power = std::pow(10, std::ceil(std::log10(length)));
  return std::round((lo + hi) / 2 / power) * power;
}

std::string axis_label(const std::string& name, double offset) {
  if (offset == 0) return name + " [m]";
  const double exponent = std::floor(std::log10(std::abs(offset)));
  return fmt::format("{} [m] {}{:.12g}e{:.0f}", name, offset < 0 ? "−" : "+",
                     std::abs(offset) / std::pow(10, exponent), exponent);
}

void Labels::keep_clear(Point centre, double rx, double ry) {
  taken_.push_back({centre.x - rx, centre.x + rx, centre.y - ry, centre.y + ry});
}

bool Labels::place(const std::string& text, const std::string& colour,
                   const std::vector<Place>& places) {
  // The mean advance of the widest of the fonts that stand in for Helvetica.
  const double width = 0.6 * kSize * static_cast<double>(text.size());
  for (const auto& [at, anchor] : places) {
    const double left = anchor == "start" ? 0 : anchor == "end" ? width : width / 2;
    const Box box = {at.x - left, at.x - left + width, at.y - 0.85 * kSize, at.y + 0.35 * kSize};
    if (!free(box)) continue;
    taken_.push_back(box);
    svg_.text(at, text, {.size = kSize, .anchor = anchor, .colour = colour, .halo = true});
    return true;
  }
  return false;
}

bool Labels::free(const Box& box) const {
  const auto& c = view_.corner;
  if (box.x0 < c.x || box.x1 > c.x + view_.width()) return false;
  if (box.y0 < c.y || box.y1 > c.y + view_.height()) return false;
  return std::none_of(taken_.begin(), taken_.end(), [&](const Box& other) {
    return box.x0 < other.x1 && other.x0 < box.x1 && box.y0 < other.y1 && other.y0 < box.y1;
  });
}

}  // namespace slalom::report
