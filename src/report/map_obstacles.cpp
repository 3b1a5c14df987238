#include "map_obstacles.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "html.hpp"
#include "shapes.hpp"

namespace slalom::report {
namespace {

constexpr double kSmall = 6;         ///< letters inside obstacles
constexpr double kLeast = 0.6;       ///< half of what is drawn of the smallest [1/72 inch]
constexpr std::size_t kRows = 1000;  ///< of a way

/// How dark an obstacle is: from pale at the first instant to full at the last.
double shade(std::size_t i, std::size_t count) {
  return count < 2 ? 0.7 : 0.15 + 0.55 * static_cast<double>(i) / static_cast<double>(count - 1);
}

/// How far an obstacle reaches from its middle along x and y [m].
world::Point half_extents(const world::Obstacle& o, double t) {
  if (o.is_plain()) return {o.a, o.b};
  world::Point most;
  for (const auto& p : edge_of(o, t)) {
    most.x = std::max(most.x, std::fabs(p.x - o.x_at(t)));
    most.y = std::max(most.y, std::fabs(p.y - o.y_at(t)));
  }
  return most;
}

/// An obstacle's half-widths across and up the picture [1/72 inch].
Point half_widths(const world::Obstacle& o, double t, const View& view) {
  const auto half = half_extents(o, t);
  return {view.scale * (view.lying ? half.y : half.x), view.scale * (view.lying ? half.x : half.y)};
}

void draw_shape(Svg& svg, const world::Obstacle& o, double t, const View& view, const Fill& fill,
                const Stroke& stroke) {
  const auto at = view.at(o.x_at(t), o.y_at(t));
  const auto half = half_widths(o, t, view);
  if (o.is_plain() || std::max(half.x, half.y) < kLeast) {
    const double least = fill.colour.empty() ? 0 : kLeast;
    svg.ellipse(at, std::max(half.x, least), std::max(half.y, least), fill, stroke);
    return;
  }
  std::vector<Point> points;
  for (const auto& p : edge_of(o, t)) points.push_back(view.at(p.x, p.y));
  svg.polygon(points, fill, stroke);
}

void draw_way(Svg& svg, const world::Trajectory& trajectory, double end, const View& view) {
  std::vector<Point> points;
  for (const auto& row : track_of(trajectory, 0, end, kRows).rows)
    points.push_back(view.at(row.x, row.y));
  svg.polyline(points, {colours::ink, 0.5, "", 0.3});
}

}  // namespace

void add_obstacles(Box& box, const Map& map) {
  for (const auto& o : map.scenario->obstacles)
    for (const double t : map.obstacle_instants) {
      if (!o.present(t, t)) continue;
      const auto half = half_extents(o.grown(map.scenario->loop.sm_crash), t);
      box.add(o.x_at(t), o.y_at(t), half.x, half.y);
    }
}

void draw_obstacles(Svg& svg, const Map& map, const View& view) {
  const double sm = map.scenario->loop.sm_crash;
  const auto count = map.obstacle_instants.size();
  for (const auto& o : map.scenario->obstacles)
    if (o.trajectory && count > 0) draw_way(svg, *o.trajectory, map.obstacle_instants.back(), view);
  for (std::size_t i = 0; i < count; ++i) {
    for (const auto& o : map.scenario->obstacles) {
      const double t = map.obstacle_instants[i];
      if ((!o.moves() && i + 1 < count) || !o.present(t, t)) continue;
      draw_shape(svg, o.grown(sm), t, view, {}, {colours::muted, 0.4, "1.5 1.5", 1});
      draw_shape(svg, o, t, view, {colours::ink, shade(i, count)}, {colours::ink, 0.4, "", 1});
    }
  }
}

void draw_held_obstacles(Svg& svg, const Map& map, const MapVehicle& v, const View& view) {
  if (!v.plan->obstacle_time_held) return;
  const double t = *v.plan->obstacle_time_held;
  for (const auto& o : map.scenario->obstacles)
    if (o.moves() && o.present(t, t))
      draw_shape(svg, o.grown(map.scenario->loop.sm_crash), t, view, {},
                 {v.stroke.colour, 0.7, "2 1.5", 1});
}

void name_obstacles(Svg& svg, Labels& labels, const Map& map, const View& view) {
  const auto count = map.obstacle_instants.size();
  for (const auto& o : map.scenario->obstacles) {
    if (view.scale * std::max(o.a, o.b) < 2) continue;
    for (std::size_t i = count; i-- > (o.moves() ? 0 : count - 1);) {
      const double t = map.obstacle_instants[i];
      if (!view.shows(o.x_at(t), o.y_at(t)) || !o.present(t, t)) continue;
      const auto name = o.moves() ? fmt::format("{}, {} s", o.name, number(t, 1)) : o.name;
      const auto at = view.at(o.x_at(t), o.y_at(t));
      const auto half = half_widths(o, t, view);
      if (count == 1 && std::min(half.x, half.y) > 0.4 * kSmall * double(name.size())) {
        svg.text({at.x, at.y + 2}, name, {kSmall, "middle", "#ffffff", true});
        continue;
      }
      const auto grown = half_widths(o.grown(map.scenario->loop.sm_crash), t, view);
      const Place left{{at.x - grown.x - 2, at.y + 2}, "end"},
          right{{at.x + grown.x + 2, at.y + 2}, "start"},
          above{{at.x, at.y - grown.y - 2}, "middle"}, below{{at.x, at.y + grown.y + 6}, "middle"};
      if (view.lying)
        labels.place(name, colours::ink, {below, above, right, left});
      else
        labels.place(name, colours::ink, {left, above, below, right});
    }
  }
}

void keep_clear_of_obstacles(Labels& labels, const Map& map, const View& view) {
  for (const auto& o : map.scenario->obstacles)
    for (const double t : map.obstacle_instants) {
      if (!o.present(t, t)) continue;
      const auto half = half_widths(o, t, view);
      labels.keep_clear(view.at(o.x_at(t), o.y_at(t)), 0.8 * half.x, 0.8 * half.y);
    }
}

}  // namespace slalom::report
