#include "map.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "html.hpp"
#include "map_obstacles.hpp"
#include "map_road.hpp"
#include "map_view.hpp"
#include "shapes.hpp"
#include "slalom/report/plot.hpp"
#include "words.hpp"

namespace slalom::report {
namespace {

constexpr double kLeft = 28, kRight = 6, kBelow = 20;
constexpr double kLabelRow = 8;
constexpr double kTallest = 330;  ///< of an upright map's frame [1/72 inch]

Box course(const Map& map) {
  const auto& scenario = *map.scenario;
  Box box;
  box.add(scenario.start[vehicle::X], scenario.start[vehicle::Y], 6, 6);
  for (const auto& p : goal_shape(scenario)) box.add(p.x, p.y, 0, 0);
  add_obstacles(box, map);
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
  draw_road(svg, map, view);
  draw_goal(svg, map, view);
}

void draw_path(Svg& svg, const MapVehicle& v, const View& view) {
  std::vector<Point> points;
  for (const auto& s : v.drive->plant)
    points.push_back(view.at(s.state[vehicle::X], s.state[vehicle::Y]));
  svg.polyline(points, v.stroke);
}

/// The vehicle to scale; its front axle's centre is the reference. At least 7 points long where
/// that centre alone keeps off obstacles.
void draw_vehicle(Svg& svg, const vehicle::Parameters& p, const vehicle::State& state,
                  const std::string& colour, const View& view) {
  const bool is_point = p.footprint == vehicle::FootprintKind::point;
  const double size = is_point ? std::max(1.0, 7 / (p.length * view.scale)) : 1;
  const double front = p.front_overhang * size;
  const double back = front - p.length * size;
  const double half = p.width / 2 * size;
  const double c = std::cos(state[vehicle::PSI]), s = std::sin(state[vehicle::PSI]);
  std::vector<Point> corners;
  for (const auto& [l, w] : {std::pair{front, half}, {front, -half}, {back, -half}, {back, half}})
    corners.push_back(
        view.at(state[vehicle::X] + l * c - w * s, state[vehicle::Y] + l * s + w * c));
  svg.polygon(corners, {colour, 1}, {"#ffffff", 0.4, "", 1});
}

/// Where the vehicle's plan wants its front axle, node by node, and where it takes the moving
/// obstacles to be, if it holds them.
void draw_plan(Svg& svg, const Map& map, const MapVehicle& v, const View& view) {
  if (v.plan == nullptr) return;
  std::vector<Point> points;
  for (const auto& state : v.plan->states)
    points.push_back(view.at(state[vehicle::X], state[vehicle::Y]));
  svg.polyline(points, {v.stroke.colour, 0.7, "1 1.2", 1});
  for (const auto& p : points) svg.ellipse(p, 1.3, 1.3, {v.stroke.colour, 1});
  draw_held_obstacles(svg, map, v, view);
}

void draw_printed_positions(Svg& svg, const Map& map, const View& view) {
  for (const auto& v : map.vehicles)
    for (const auto& s : v.printed)
      if (view.shows(s.x, s.y))
        svg.ellipse(view.at(s.x, s.y), 2.2, 2.2, {"#ffffff", 0.45},
                    {v.stroke.colour, 0.9, s.comparable ? "" : "1 1", 1});
}

/// How far beside a vehicle's reference point words stand clear of it.
double label_offset(const Map& map, const View& view) {
  return std::max(7.0, map.scenario->vehicle.width * view.scale + 3);
}

std::vector<Place> beside(Point at, double off) {
  std::vector<Place> places;
  for (const double up : {2.0, -4.0, 8.0, -10.0, 14.0}) {
    places.push_back({{at.x + off, at.y + up}, "start"});
    places.push_back({{at.x - off, at.y + up}, "end"});
  }
  return places;
}

/// A vehicle on the map at one instant.
struct Standing {
  const MapVehicle* vehicle;
  double t;
  vehicle::State state;
  double row;  ///< of its label where the map lies
};

std::vector<Standing> standing(const Map& map, const View& view) {
  std::vector<Standing> found;
  double row = 0;
  for (const auto& v : map.vehicles) {
    for (const double t : v.instants) {
      if (v.drive->plant.empty() || t > v.drive->time + 0.05) continue;
      const auto state = state_at(*v.drive, t);
      if (view.shows(state[vehicle::X], state[vehicle::Y]))
        found.push_back({&v, std::min(t, v.drive->time), state, row});
    }
    ++row;
  }
  return found;
}

/// Who and when: beside the vehicle, or above the road with a line down to it. At the start all
/// stand at one place, which needs no words.
void name_vehicles(Svg& svg, Labels& labels, const Map& map, const View& view,
                   const std::vector<Standing>& vehicles) {
  for (const auto& one : vehicles) {
    if (one.t == 0 && map.vehicles.size() > 1) continue;
    const auto at = view.at(one.state[vehicle::X], one.state[vehicle::Y]);
    const auto time = number(one.t, 1) + " s";
    const auto& name = one.vehicle->label;
    const auto label =
        map.vehicles.size() > 1 && !name.empty() ? fmt::format("{}, {}", name, time) : time;
    const auto& colour = one.vehicle->stroke.colour;
    if (!view.lying) {
      labels.place(label, colour, beside(at, label_offset(map, view)));
      continue;
    }
    const double top = view.corner.y + 7 + kLabelRow * one.row;
    if (labels.place(label, colour,
                     {{{at.x, top}, "middle"}, {{at.x, top}, "start"}, {{at.x, top}, "end"}}))
      svg.line({at.x, top + 1.5}, {at.x, at.y - 3}, {colour, 0.4, "1 1", 1});
  }
}

/// Words keep off the paths and the obstacles.
void keep_clear(Labels& labels, const Map& map, const View& view) {
  keep_clear_of_obstacles(labels, map, view);
  for (const auto& v : map.vehicles)
    for (std::size_t i = 0; i < v.drive->plant.size(); i += 5) {
      const auto& state = v.drive->plant[i].state;
      if (view.shows(state[vehicle::X], state[vehicle::Y]))
        labels.keep_clear(view.at(state[vehicle::X], state[vehicle::Y]), 1.5, 1.5);
    }
}

void draw_axes(Svg& svg, const View& view, bool x_ticks, bool x_label) {
  const auto& box = view.box;
  const double bottom = view.corner.y + view.height();
  const double across0 = view.lying ? box.y0 : box.x0, across1 = view.lying ? box.y1 : box.x1;
  const double up0 = view.lying ? box.x0 : box.y0, up1 = view.lying ? box.x1 : box.y1;
  const double across_from = axis_offset(across0, across1), up_from = axis_offset(up0, up1);
  const auto across =
      nice_ticks(across0 - across_from, across1 - across_from, std::max(2, int(view.width() / 34)));
  for (const double v : across.at) {
    const double at = across_from + v;
    const auto p = view.lying ? view.at(box.x0, at) : view.at(at, box.y0);
    svg.line({p.x, view.corner.y}, {p.x, bottom}, {colours::grid, 0.5, "", 1});
    if (x_ticks) svg.text({p.x, bottom + 8}, number(v, across.digits()), {6.5, "middle"});
  }
  const auto up = nice_ticks(up0 - up_from, up1 - up_from,
                             std::max(1, int(view.height() / (view.lying ? 11 : 26))));
  for (const double v : up.at) {
    const double at = up_from + v;
    const auto p = view.lying ? view.at(at, box.y0) : view.at(box.x0, at);
    svg.line({view.corner.x, p.y}, {view.corner.x + view.width(), p.y},
             {colours::grid, 0.5, "", 1});
    svg.text({view.corner.x - 3, p.y + 2.3}, number(v, up.digits()), {6.5, "end"});
  }
  if (x_label)
    svg.text({view.corner.x + view.width() / 2, bottom + 17},
             axis_label(view.lying ? "y" : "x", across_from), {7, "middle"});
  svg.text({view.corner.x - 20, view.corner.y + view.height() / 2},
           axis_label(view.lying ? "x" : "y", up_from), {7, "middle", colours::ink, false, 90});
}

void draw_view(Svg& svg, const Map& map, const View& view, bool x_ticks, bool x_label) {
  svg.begin_clip(view.corner, view.width(), view.height());
  draw_ground(svg, map, view);
  svg.end_clip();
  draw_axes(svg, view, x_ticks, x_label);
  svg.begin_clip(view.corner, view.width(), view.height());
  draw_obstacles(svg, map, view);
  for (const auto& v : map.vehicles) draw_path(svg, v, view);
  const auto vehicles = standing(map, view);
  for (const auto& one : vehicles)
    draw_vehicle(svg, map.scenario->vehicle, one.state, one.vehicle->stroke.colour, view);
  for (const auto& v : map.vehicles) draw_plan(svg, map, v, view);
  draw_printed_positions(svg, map, view);
  Labels labels(svg, view);
  keep_clear(labels, map, view);
  for (const auto& one : vehicles) {
    const double half = std::max(3.5, 0.6 * map.scenario->vehicle.length * view.scale);
    labels.keep_clear(view.at(one.state[vehicle::X], one.state[vehicle::Y]), half / 2, half);
  }
  name_vehicles(svg, labels, map, view, vehicles);
  name_obstacles(svg, labels, map, view);
  svg.end_clip();
  svg.rect(view.corner, view.width(), view.height(), {}, {colours::muted, 0.6, "", 1});
}

std::vector<Series> legend(const Map& map) {
  std::vector<Series> entries;
  bool printed = false;
  for (const auto& v : map.vehicles) {
    entries.push_back({v.label, {}, {}, v.stroke, false, false});
    printed |= !v.printed.empty();
  }
  const auto planned = std::find_if(map.vehicles.begin(), map.vehicles.end(),
                                    [](const auto& v) { return v.plan != nullptr; });
  if (planned != map.vehicles.end())
    entries.push_back({"plan", {}, {}, {planned->stroke.colour, 0.7, "1 1.2", 1}, true, false});
  if (printed)
    entries.push_back({"paper’s positions", {}, {}, {colours::ink, 0, "", 1}, true, true});
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
  for (const auto& view : views) draw_view(svg, map, view, true, &view == &views.back());
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
    box.x0 -= 10 + 11 * static_cast<double>(map.vehicles.size());
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

std::string strips_svg(const std::string& name, const std::string& title,
                       const std::vector<Strip>& strips) {
  constexpr double heading = 11, gap = 3;
  Box box;
  for (const auto& strip : strips) {
    const auto own = course(strip.map);
    box.add(own.x0, own.y0, 0, 0);
    box.add(own.x1, own.y1, 0, 0);
  }
  if (strips.empty()) box.add(0, 0, 1, 1);
  View view{box, {}, (kColumnWidth - kLeft - kRight) / (box.y1 - box.y0), true};
  view.box.x0 -= (kLabelRow + 2) / view.scale;  // room for the instants
  const double each = heading + view.height() + gap;
  Svg svg(name, kColumnWidth, each * static_cast<double>(strips.size()) + kBelow, title);
  svg.rect({0, 0}, svg.width(), svg.height(), {"#ffffff", 1});
  double y = 0;
  for (const auto& strip : strips) {
    svg.text({kLeft, y + 8}, strip.heading, {7, "start", colours::ink, true});
    view.corner = {kLeft, y + heading};
    const bool last = &strip == &strips.back();
    draw_view(svg, strip.map, view, last, last);
    y += each;
  }
  return svg.str();
}

}  // namespace slalom::report
