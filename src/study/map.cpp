#include "map.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "html.hpp"
#include "slalom/study/plot.hpp"
#include "words.hpp"

namespace slalom::study {
namespace {

constexpr double kLeft = 28, kRight = 6, kBelow = 20;
constexpr double kTallest = 330;  ///< of an upright map's frame [1/72 inch]

/// A rectangle of the plane [m].
struct Box {
  double x0 = std::numeric_limits<double>::infinity();
  double x1 = -std::numeric_limits<double>::infinity();
  double y0 = std::numeric_limits<double>::infinity();
  double y1 = -std::numeric_limits<double>::infinity();
  void add(double x, double y, double rx, double ry) {
    x0 = std::min(x0, x - rx);
    x1 = std::max(x1, x + rx);
    y0 = std::min(y0, y - ry);
    y1 = std::max(y1, y + ry);
  }
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

/// Puts words on a map where there is still room for them.
class Labels {
 public:
  Labels(Svg& svg, const View& view) : svg_(svg), view_(view) {}

  /// Room that words must leave free.
  void keep_clear(Point centre, double rx, double ry) {
    taken_.push_back({centre.x - rx, centre.x + rx, centre.y - ry, centre.y + ry});
  }
  /// Writes at the first free one of these places, each the left, middle or right of the base
  /// line as its anchor says; nowhere if none is free.
  void place(const std::string& text, const std::string& colour,
             const std::vector<std::pair<Point, std::string_view>>& places) {
    const double width = 0.55 * kSize * static_cast<double>(text.size());
    for (const auto& [at, anchor] : places) {
      const double left = anchor == "start" ? 0 : anchor == "end" ? width : width / 2;
      const Box box = {at.x - left, at.x - left + width, at.y - 0.85 * kSize, at.y + 0.35 * kSize};
      if (!free(box)) continue;
      taken_.push_back(box);
      svg_.text(at, text, {kSize, anchor, colour});
      return;
    }
  }

 private:
  static constexpr double kSize = 5.5;
  bool free(const Box& box) const {
    const auto& c = view_.corner;
    if (box.x0 < c.x || box.x1 > c.x + view_.width()) return false;
    if (box.y0 < c.y || box.y1 > c.y + view_.height()) return false;
    return std::none_of(taken_.begin(), taken_.end(), [&](const Box& other) {
      return box.x0 < other.x1 && other.x0 < box.x1 && box.y0 < other.y1 && other.y0 < box.y1;
    });
  }

  Svg& svg_;
  const View& view_;
  std::vector<Box> taken_;
};

Box course(const Map& map) {
  const auto& scenario = *map.scenario;
  const double sm = scenario.loop.sm_crash;
  Box box;
  box.add(scenario.start[vehicle::X], scenario.start[vehicle::Y], 6, 6);
  box.add(scenario.goal.x, scenario.goal.y, scenario.goal.sigma, scenario.goal.sigma);
  for (const auto& o : scenario.obstacles)
    for (const double t : map.obstacle_instants) box.add(o.x_at(t), o.y_at(t), o.a + sm, o.b + sm);
  for (const auto& v : map.vehicles)
    for (const auto& s : v.drive->plant) box.add(s.state[vehicle::X], s.state[vehicle::Y], 4, 4);
  for (const double x : {scenario.region.x_min, scenario.region.x_max})
    if (std::isfinite(x)) box.add(x, scenario.start[vehicle::Y], 2, 0);
  return box;
}

void draw_ground(Svg& svg, const Map& map, const View& view) {
  const auto& box = view.box;
  const auto& region = map.scenario->region;
  const auto band = [&](double xa, double xb, double ya, double yb) {
    if (!(xa < xb) || !(ya < yb)) return;
    const auto a = view.at(xa, ya), b = view.at(xb, yb);
    svg.rect({std::min(a.x, b.x), std::min(a.y, b.y)}, std::abs(b.x - a.x), std::abs(b.y - a.y),
             {"#dfe9f3", 1});
  };
  band(box.x0, std::min(box.x1, region.x_min), box.y0, box.y1);
  band(std::max(box.x0, region.x_max), box.x1, box.y0, box.y1);
  band(box.x0, box.x1, box.y0, std::min(box.y1, region.y_min));
  band(box.x0, box.x1, std::max(box.y0, region.y_max), box.y1);
  const auto& goal = map.scenario->goal;
  const auto a = view.at(goal.x - goal.sigma, goal.y - goal.sigma);
  const auto b = view.at(goal.x + goal.sigma, goal.y + goal.sigma);
  svg.rect({std::min(a.x, b.x), std::min(a.y, b.y)}, std::abs(b.x - a.x), std::abs(b.y - a.y),
           {colours::green, 0.16}, {colours::green, 0.7, "", 1});
}

/// How dark an obstacle is: from pale at the first instant to full at the last.
double shade(std::size_t i, std::size_t count) {
  return count < 2 ? 0.7 : 0.15 + 0.55 * static_cast<double>(i) / static_cast<double>(count - 1);
}

void draw_obstacles(Svg& svg, const Map& map, const View& view) {
  const double sm = map.scenario->loop.sm_crash;
  const auto count = map.obstacle_instants.size();
  for (std::size_t i = 0; i < count; ++i) {
    for (const auto& o : map.scenario->obstacles) {
      const bool moves = o.vx != 0 || o.vy != 0;
      if (!moves && i + 1 < count) continue;
      const double t = map.obstacle_instants[i];
      const auto at = view.at(o.x_at(t), o.y_at(t));
      const double rx = view.scale * (view.lying ? o.b : o.a);
      const double ry = view.scale * (view.lying ? o.a : o.b);
      const double grown = view.scale * sm;
      svg.ellipse(at, rx + grown, ry + grown, {}, {colours::muted, 0.4, "1.5 1.5", 1});
      svg.ellipse(at, std::max(rx, 0.6), std::max(ry, 0.6), {colours::ink, shade(i, count)},
                  {colours::ink, 0.4, "", 1});
    }
  }
}

/// Names of the larger obstacles; with the instant for those that move.
void name_obstacles(Labels& labels, const Map& map, const View& view) {
  const auto count = map.obstacle_instants.size();
  for (const auto& o : map.scenario->obstacles) {
    const bool moves = o.vx != 0 || o.vy != 0;
    if (view.scale * std::max(o.a, o.b) < 2) continue;
    for (std::size_t i = count; i-- > (moves ? 0 : count - 1);) {
      const double t = map.obstacle_instants[i];
      if (!view.shows(o.x_at(t), o.y_at(t))) continue;
      const auto name = moves ? fmt::format("{}, {} s", o.name, number(t, 1)) : o.name;
      const auto at = view.at(o.x_at(t), o.y_at(t));
      const double across = view.scale * ((view.lying ? o.b : o.a) + map.scenario->loop.sm_crash);
      const double up = view.scale * ((view.lying ? o.a : o.b) + map.scenario->loop.sm_crash);
      const std::pair<Point, std::string_view> left{{at.x - across - 2, at.y + 2}, "end"},
          right{{at.x + across + 2, at.y + 2}, "start"}, above{{at.x, at.y - up - 2}, "middle"},
          below{{at.x, at.y + up + 6}, "middle"};
      if (view.lying)
        labels.place(name, colours::ink, {below, above, right, left});
      else
        labels.place(name, colours::ink, {left, above, below, right});
    }
  }
}

void draw_path(Svg& svg, const MapVehicle& v, const View& view) {
  std::vector<Point> points;
  for (const auto& s : v.drive->plant)
    points.push_back(view.at(s.state[vehicle::X], s.state[vehicle::Y]));
  svg.polyline(points, v.stroke);
}

/// The vehicle to scale, but at least 7 points long; its front axle's centre is the reference.
void draw_vehicle(Svg& svg, const vehicle::Parameters& p, const vehicle::State& state,
                  const std::string& colour, const View& view) {
  const double size = std::max(1.0, 7 / (p.length * view.scale));
  const double front = std::max((p.length - p.la - p.lb) / 2, 0.0) * size;
  const double back = front - p.length * size;
  const double half = p.width / 2 * size;
  const double c = std::cos(state[vehicle::PSI]), s = std::sin(state[vehicle::PSI]);
  std::vector<Point> corners;
  for (const auto& [l, w] : {std::pair{front, half}, {front, -half}, {back, -half}, {back, half}})
    corners.push_back(
        view.at(state[vehicle::X] + l * c - w * s, state[vehicle::Y] + l * s + w * c));
  svg.polygon(corners, {colour, 1}, {"#ffffff", 0.4, "", 1});
}

void draw_paper_positions(Svg& svg, const Map& map, const View& view) {
  for (const auto& v : map.vehicles)
    for (const auto& s : v.paper)
      if (view.shows(s.x, s.y))
        svg.ellipse(view.at(s.x, s.y), 2.2, 2.2, {"#ffffff", 0.45},
                    {v.stroke.colour, 0.9, s.comparable ? "" : "1 1", 1});
}

/// How far beside a vehicle's reference point words stand clear of it.
double label_offset(const Map& map, const View& view) {
  return std::max(7.0, map.scenario->vehicle.width * view.scale + 3);
}

std::vector<std::pair<Point, std::string_view>> beside(Point at, double off) {
  std::vector<std::pair<Point, std::string_view>> places;
  for (const double up : {2.0, -4.0, 8.0}) {
    places.push_back({{at.x + off, at.y + up}, "start"});
    places.push_back({{at.x - off, at.y + up}, "end"});
  }
  return places;
}

void draw_vehicles(Svg& svg, Labels& labels, const Map& map, const View& view) {
  double row = 0;
  for (const auto& v : map.vehicles) {
    for (const double t : v.instants) {
      if (v.drive->plant.empty() || t > v.drive->time + 0.05) continue;
      const auto state = state_at(*v.drive, t);
      if (!view.shows(state[vehicle::X], state[vehicle::Y])) continue;
      draw_vehicle(svg, map.scenario->vehicle, state, v.stroke.colour, view);
      const auto at = view.at(state[vehicle::X], state[vehicle::Y]);
      const auto label = number(std::min(t, v.drive->time), 1) + " s";
      const double top = view.corner.y + 7 + 6.5 * row;
      if (view.lying)
        labels.place(label, v.stroke.colour,
                     {{{at.x, top}, "middle"}, {{at.x, top}, "start"}, {{at.x, top}, "end"}});
      else
        labels.place(label, v.stroke.colour, beside(at, label_offset(map, view)));
    }
    ++row;
  }
}

/// Words keep off the paths and the obstacles.
void keep_clear(Labels& labels, const Map& map, const View& view) {
  for (const auto& o : map.scenario->obstacles)
    for (const double t : map.obstacle_instants)
      labels.keep_clear(view.at(o.x_at(t), o.y_at(t)), 0.8 * view.scale * (view.lying ? o.b : o.a),
                        0.8 * view.scale * (view.lying ? o.a : o.b));
  for (const auto& v : map.vehicles)
    for (std::size_t i = 0; i < v.drive->plant.size(); i += 5) {
      const auto& state = v.drive->plant[i].state;
      if (view.shows(state[vehicle::X], state[vehicle::Y]))
        labels.keep_clear(view.at(state[vehicle::X], state[vehicle::Y]), 1.5, 1.5);
    }
}

void draw_axes(Svg& svg, const View& view, bool x_label) {
  const auto& box = view.box;
  const double bottom = view.corner.y + view.height();
  const double across0 = view.lying ? box.y0 : box.x0, across1 = view.lying ? box.y1 : box.x1;
  const double up0 = view.lying ? box.x0 : box.y0, up1 = view.lying ? box.x1 : box.y1;
  const auto across = nice_ticks(across0, across1, std::max(2, int(view.width() / 34)));
  for (const double v : across.at) {
    const auto p = view.lying ? view.at(box.x0, v) : view.at(v, box.y0);
    svg.line({p.x, view.corner.y}, {p.x, bottom}, {colours::grid, 0.5, "", 1});
    svg.text({p.x, bottom + 8}, number(v, across.digits()), {6.5, "middle"});
  }
  const auto up = nice_ticks(up0, up1, std::max(1, int(view.height() / (view.lying ? 11 : 26))));
  for (const double v : up.at) {
    const auto p = view.lying ? view.at(v, box.y0) : view.at(box.x0, v);
    svg.line({view.corner.x, p.y}, {view.corner.x + view.width(), p.y},
             {colours::grid, 0.5, "", 1});
    svg.text({view.corner.x - 3, p.y + 2.3}, number(v, up.digits()), {6.5, "end"});
  }
  if (x_label)
    svg.text({view.corner.x + view.width() / 2, bottom + 17}, view.lying ? "y [m]" : "x [m]",
             {7, "middle"});
  svg.text({view.corner.x - 20, view.corner.y + view.height() / 2}, view.lying ? "x [m]" : "y [m]",
           {7, "middle", colours::ink, false, 90});
}

void draw_view(Svg& svg, const Map& map, const View& view, bool x_label) {
  svg.begin_clip(view.corner, view.width(), view.height());
  draw_ground(svg, map, view);
  svg.end_clip();
  draw_axes(svg, view, x_label);
  svg.begin_clip(view.corner, view.width(), view.height());
  draw_obstacles(svg, map, view);
  for (const auto& v : map.vehicles) draw_path(svg, v, view);
  Labels labels(svg, view);
  keep_clear(labels, map, view);
  draw_vehicles(svg, labels, map, view);
  draw_paper_positions(svg, map, view);
  name_obstacles(labels, map, view);
  svg.end_clip();
  svg.rect(view.corner, view.width(), view.height(), {}, {colours::muted, 0.6, "", 1});
}

std::vector<Series> legend(const Map& map) {
  std::vector<Series> entries;
  bool paper = false;
  for (const auto& v : map.vehicles) {
    entries.push_back({v.label, {}, {}, v.stroke, false, false});
    paper |= !v.paper.empty();
  }
  if (paper) entries.push_back({"paper’s positions", {}, {}, {colours::ink, 0, "", 1}, true, true});
  return entries;
}

std::string picture(const std::string& name, const std::string& title, const Map& map,
                    std::vector<View> views) {
  Svg trial(name, kColumnWidth, 0, title);
  const double room = kColumnWidth - kLeft - kRight;
  const double head = draw_legend(trial, legend(map), {kLeft, 0}, room) + 2;
  double height = head;
  for (auto& view : views) {
    view.corner = {kLeft, height};
    height += view.height() + (&view == &views.back() ? kBelow : 14);
  }
  Svg svg(name, kColumnWidth, height, title);
  svg.rect({0, 0}, svg.width(), svg.height(), {"#ffffff", 1});
  draw_legend(svg, legend(map), {kLeft, 0}, room);
  for (const auto& view : views) draw_view(svg, map, view, &view == &views.back());
  return svg.str();
}

}  // namespace

std::vector<double> thirds(const sim::Drive& drive) {
  return {0, drive.time / 3, 2 * drive.time / 3, drive.time};
}

std::string map_svg(const std::string& name, const std::string& title, const Map& map) {
  Box box = course(map);
  const double room = kColumnWidth - kLeft - kRight;
  const double wide = box.x1 - box.x0, tall = box.y1 - box.y0;
  if (tall > 6 * wide) {
    // Room above and below the road for the instants and names.
    box.x0 -= 8 + 8 * static_cast<double>(map.vehicles.size());
    box.x1 += 8;
    std::vector<View> strips;
    for (int i = 0; i < 3; ++i) {
      Box part = box;
      part.y0 = box.y0 + tall * i / 3;
      part.y1 = box.y0 + tall * (i + 1) / 3;
      strips.push_back({part, {}, 3 * room / tall, true});
    }
    return picture(name, title, map, strips);
  }
  const double scale = std::min(room / wide, kTallest / tall);
  const double spare = room / scale - wide;
  box.x0 -= spare / 2;
  box.x1 += spare / 2;
  return picture(name, title, map, {{box, {}, scale, false}});
}

std::string zoom_svg(const std::string& name, const std::string& title, const Map& map, double x,
                     double y, double half) {
  Box box;
  box.add(x, y, half, half);
  return picture(name, title, map,
                 {{box, {}, (kColumnWidth - kLeft - kRight) / (2 * half), false}});
}

}  // namespace slalom::study
