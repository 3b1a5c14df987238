#include "slalom/report/svg.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <utility>
#include <vector>

#include "html.hpp"

namespace slalom::report {
namespace {

bool finite(Point p) {
  return std::isfinite(p.x) && std::isfinite(p.y);
}

/// A coordinate: two decimals are 1/7200 inch; without trailing zeros.
std::string coordinate(double value) {
  auto text = fmt::format("{:.2f}", value);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text == "-0" ? "0" : text;
}

std::string attributes(const Fill& fill) {
  if (fill.colour.empty()) return " fill=\"none\"";
  auto text = fmt::format(" fill=\"{}\"", fill.colour);
  if (fill.opacity < 1) text += fmt::format(" fill-opacity=\"{}\"", coordinate(fill.opacity));
  return text;
}

std::string attributes(const Stroke& stroke) {
  if (stroke.colour.empty()) return "";
  auto text =
      fmt::format(" stroke=\"{}\" stroke-width=\"{}\"", stroke.colour, coordinate(stroke.width));
  if (!stroke.dash.empty()) text += fmt::format(" stroke-dasharray=\"{}\"", stroke.dash);
  if (stroke.opacity < 1) text += fmt::format(" stroke-opacity=\"{}\"", coordinate(stroke.opacity));
  return text;
}

/// How far p lies from the line from a to b.
double away(Point p, Point a, Point b) {
  const double dx = b.x - a.x, dy = b.y - a.y, length = std::hypot(dx, dy);
  if (length == 0) return std::hypot(p.x - a.x, p.y - a.y);
  const double along = ((p.x - a.x) * dx + (p.y - a.y) * dy) / (length * length);
  const double share = std::clamp(along, 0.0, 1.0);
  return std::hypot(p.x - a.x - share * dx, p.y - a.y - share * dy);
}

/// The points without which the line would move by more than .04 (14 micrometres in print), by
/// Douglas and Peucker (1973).
std::vector<Point> thinned(const std::vector<Point>& points) {
  constexpr double tolerance = 0.04;
  std::vector<bool> kept(points.size(), false);
  kept.front() = kept.back() = true;
  std::vector<std::pair<std::size_t, std::size_t>> parts = {{0, points.size() - 1}};
  while (!parts.empty()) {
    const auto [first, last] = parts.back();
    parts.pop_back();
    double farthest = tolerance;
    std::size_t at = 0;
    for (std::size_t i = first + 1; i < last; ++i)
      if (const double d = away(points[i], points[first], points[last]); d > farthest) {
        farthest = d;
        at = i;
      }
    if (at == 0) continue;
    kept[at] = true;
    parts.emplace_back(first, at);
    parts.emplace_back(at, last);
  }
  std::vector<Point> left;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (kept[i]) left.push_back(points[i]);
  return left;
}

std::string joined(const std::vector<Point>& points) {
  std::string text;
  for (const auto& p : points) {
    if (!finite(p)) continue;
    if (!text.empty()) text += ' ';
    text += coordinate(p.x) + "," + coordinate(p.y);
  }
  return text;
}

/// A document from its root on, and its size.
struct Drawing {
  std::string_view text;
  double width = 0, height = 0;
};

Drawing drawing_of(std::string_view document) {
  Drawing drawing{document.substr(std::min(document.find("<svg"), document.size()))};
  const auto number_after = [&](std::string_view key) {
    const auto at = drawing.text.find(key);
    return at == drawing.text.npos ? 0
                                   : std::strtod(drawing.text.data() + at + key.size(), nullptr);
  };
  drawing.width = number_after(" width=\"");
  drawing.height = number_after(" height=\"");
  return drawing;
}

std::string document(double width, double height, const std::string& title,
                     const std::string& body) {
  return fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{}pt\" height=\"{}pt\" "
      "viewBox=\"0 0 {} {}\" role=\"img\" "
      "font-family=\"Helvetica, Arial, 'DejaVu Sans', sans-serif\">\n<title>{}</title>\n{}</svg>\n",
      coordinate(width), coordinate(height), coordinate(width), coordinate(height), escape(title),
      body);
}

}  // namespace

std::string side_by_side(const std::string& title, const std::vector<std::string>& documents,
                         double gap) {
  double width = 0, height = 0;
  std::string body;
  for (const auto& one : documents) {
    const auto drawing = drawing_of(one);
    if (drawing.text.empty()) continue;
    if (!body.empty()) width += gap;
    // Inside a picture, a length in points would be one of 4/3 of its units.
    body += fmt::format("<svg x=\"{}\" width=\"{}\" height=\"{}\" viewBox=\"0 0 {} {}\">{}",
                        coordinate(width), coordinate(drawing.width), coordinate(drawing.height),
                        coordinate(drawing.width), coordinate(drawing.height),
                        drawing.text.substr(drawing.text.find('>') + 1));
    width += drawing.width;
    height = std::max(height, drawing.height);
  }
  const auto ground = fmt::format("<rect width=\"{}\" height=\"{}\" fill=\"#ffffff\"/>\n",
                                  coordinate(width), coordinate(height));
  return document(width, height, title, ground + body);
}

Svg::Svg(const std::string& name, double width, double height, std::string title)
    : name_(plain_name(name)), title_(std::move(title)), width_(width), height_(height) {}

void Svg::line(Point a, Point b, const Stroke& stroke) {
  if (!finite(a) || !finite(b)) return;
  body_ += fmt::format("<line x1=\"{}\" y1=\"{}\" x2=\"{}\" y2=\"{}\"{}/>\n", coordinate(a.x),
                       coordinate(a.y), coordinate(b.x), coordinate(b.y), attributes(stroke));
}

void Svg::polyline(const std::vector<Point>& points, const Stroke& stroke) {
  std::vector<Point> part;
  const auto flush = [&] {
    if (part.size() > 1)
      body_ += fmt::format("<polyline points=\"{}\" fill=\"none\" stroke-linejoin=\"round\"{}/>\n",
                           joined(thinned(part)), attributes(stroke));
    part.clear();
  };
  for (const auto& p : points) {
    if (finite(p))
      part.push_back(p);
    else
      flush();
  }
  flush();
}

void Svg::polygon(const std::vector<Point>& points, const Fill& fill, const Stroke& stroke) {
  body_ += fmt::format("<polygon points=\"{}\"{}{}/>\n", joined(points), attributes(fill),
                       attributes(stroke));
}

void Svg::rect(Point corner, double width, double height, const Fill& fill, const Stroke& stroke) {
  if (!finite(corner) || !(width >= 0) || !(height >= 0) || !finite({width, height})) return;
  body_ += fmt::format("<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\"{}{}/>\n",
                       coordinate(corner.x), coordinate(corner.y), coordinate(width),
                       coordinate(height), attributes(fill), attributes(stroke));
}

void Svg::ellipse(Point centre, double rx, double ry, const Fill& fill, const Stroke& stroke) {
  if (!finite(centre) || !finite({rx, ry})) return;
  body_ += fmt::format("<ellipse cx=\"{}\" cy=\"{}\" rx=\"{}\" ry=\"{}\"{}{}/>\n",
                       coordinate(centre.x), coordinate(centre.y), coordinate(rx), coordinate(ry),
                       attributes(fill), attributes(stroke));
}

void Svg::begin_mark(std::string_view mark) {
  body_ += fmt::format("<g data-mark=\"{}\">", escape(mark));
}

void Svg::end_mark() {
  body_ += "</g>\n";
}

void Svg::text(Point at, std::string_view text, const Font& font) {
  if (!finite(at)) return;
  const auto turned = font.rotate == 0
                          ? std::string()
                          : fmt::format(" transform=\"rotate({} {} {})\"", coordinate(-font.rotate),
                                        coordinate(at.x), coordinate(at.y));
  body_ += fmt::format(
      "<text x=\"{}\" y=\"{}\" font-size=\"{}\" text-anchor=\"{}\" fill=\"{}\"{}{}{}>{}</text>\n",
      coordinate(at.x), coordinate(at.y), coordinate(font.size), font.anchor, font.colour,
      font.bold ? " font-weight=\"600\"" : "",
      font.halo ? " stroke=\"#ffffff\" stroke-width=\"1.6\" paint-order=\"stroke\"" : "", turned,
      escape(text));
}

void Svg::begin_clip(Point corner, double width, double height) {
  const auto id = fmt::format("{}-clip{}", name_, clips_++);
  body_ += fmt::format(
      "<clipPath id=\"{}\"><rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\"/></clipPath>\n"
      "<g clip-path=\"url(#{})\">\n",
      id, coordinate(corner.x), coordinate(corner.y), coordinate(width), coordinate(height), id);
}

void Svg::end_clip() {
  body_ += "</g>\n";
}

std::string Svg::str() const {
  return document(width_, height_, title_, body_);
}

}  // namespace slalom::report
