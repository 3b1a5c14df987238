#include "road_reader.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "number_table.hpp"
#include "scenario_sections.hpp"

namespace slalom::io {
namespace {

using world::Point;

bool read_closed(const Value& map) {
  const Value* closed = map.find("closed");
  if (closed == nullptr) return false;
  OptionInfo info;
  info.name = "closed";
  info.kind = OptionKind::boolean;
  const OptionValue value = to_option_value(info, *closed);
  return std::get<bool>(info.checked(value, closed->place.to_string()));
}

std::vector<std::vector<Point>> read_lanes(const Value& map) {
  std::vector<std::vector<Point>> lanes;
  const Value* list = map.find("lanes");
  if (list == nullptr) return lanes;
  for (const Value& line : items_of(*list, "a list of lanes' lines, each a list of points")) {
    std::vector<Point> points;
    for (const auto& row : read_rows(line, {{{"x", "x_m"}}, {{"y", "y_m"}}}, "a point of a lane"))
      points.push_back({row[0], row[1]});
    lanes.push_back(std::move(points));
  }
  return lanes;
}

}  // namespace

std::shared_ptr<const world::Road> read_road(const Value& map) {
  require_map(map, "a road (a map with points or file)");
  const std::vector<std::string> known = {"points", "file", "closed", "lanes"};
  for (const auto& member : map.members)
    if (std::find(known.begin(), known.end(), member.key) == known.end())
      unknown_key(member.key, member.place, "road", known);
  const Value *points = map.find("points"), *file = map.find("file");
  if ((points == nullptr) == (file == nullptr))
    throw InvalidValue(map.place.to_string(),
                       points == nullptr ? "a road without points" : "a road with points and file",
                       "points, or file");
  const Value& given = points != nullptr ? *points : *file;
  std::vector<world::RoadPoint> line;
  for (const auto& row : read_rows(given,
                                   {{{"x_m", "x"}},
                                    {{"y_m", "y"}},
                                    {{"w_tr_right_m", "w_right"}},
                                    {{"w_tr_left_m", "w_left"}}},
                                   "a point of a road"))
    line.push_back({row[0], row[1], row[2], row[3]});
  return std::make_shared<world::Road>(
      std::move(line), read_closed(map), read_lanes(map),
      given.kind == Value::Kind::scalar ? fmt::format("{}: {}", given.place.to_string(), given.text)
                                        : given.place.to_string());
}

std::string road_text(const world::Road& road) {
  std::vector<std::vector<double>> points;
  for (const auto& p : road.points()) points.push_back({p.x, p.y, p.right, p.left});
  std::string text =
      fmt::format("\n  points: {}\n  closed: {}\n", yaml_rows(points, ",\n    "), road.closed());
  std::vector<std::string> lanes;
  for (const auto& lane : road.lanes()) {
    std::vector<std::vector<double>> rows;
    for (const Point& p : lane) rows.push_back({p.x, p.y});
    lanes.push_back(yaml_rows(rows, ", "));
  }
  if (!lanes.empty()) text += fmt::format("  lanes: [{}]\n", fmt::join(lanes, ",\n    "));
  return text;
}

}  // namespace slalom::io
