#include "map_road.hpp"

#include "shapes.hpp"

namespace slalom::report {
namespace {

std::vector<Point> on_paper(const std::vector<world::Point>& line, const View& view) {
  std::vector<Point> points;
  points.reserve(line.size());
  for (const auto& p : line) points.push_back(view.at(p.x, p.y));
  return points;
}

}  // namespace

void draw_road(Svg& svg, const Map& map, const View& view) {
  if (!map.scenario->road) return;
  const RoadLines road = lines_of(*map.scenario->road);
  const auto left = on_paper(road.left, view), right = on_paper(road.right, view);
  auto surface = left;
  surface.insert(surface.end(), right.rbegin(), right.rend());
  svg.polygon(surface, {"#e9edf2", 1}, {});
  for (const auto& lane : map.scenario->road->lanes())
    svg.polyline(on_paper(lane, view), {colours::muted, 0.4, "3 3", 0.8});
  svg.polyline(on_paper(road.middle, view), {colours::muted, 0.3, "", 0.5});
  for (const auto& edge : {left, right}) svg.polyline(edge, {colours::muted, 0.8, "", 1});
}

void draw_goal(Svg& svg, const Map& map, const View& view) {
  const auto points = on_paper(goal_shape(*map.scenario), view);
  if (points.size() == 2) svg.line(points[0], points[1], {colours::green, 1.4, "", 1});
  if (points.size() > 2) svg.polygon(points, {colours::green, 0.16}, {colours::green, 0.7, "", 1});
}

}  // namespace slalom::report
