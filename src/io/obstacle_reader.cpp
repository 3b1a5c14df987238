#include "obstacle_reader.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <memory>
#include <utility>

#include "number_table.hpp"
#include "scenario_sections.hpp"

namespace slalom::io {
namespace {

using world::Obstacle;
using world::Point;

std::vector<Point> points_of(const Value& value, const std::string& what) {
  std::vector<Point> points;
  for (const auto& row : read_rows(value, {{{"x", "x_m"}}, {{"y", "y_m"}}}, what))
    points.push_back({row[0], row[1]});
  return points;
}

/// Headings along the way, for a table that states none; a body that stands keeps its own.
void head_along(std::vector<world::TrajectoryRow>& rows) {
  constexpr double still = 1e-3;  // [m]
  double psi = 0;
  bool known = false;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const auto& from = rows[k > 0 ? k - 1 : 0];
    const auto& to = rows[std::min(k + 1, rows.size() - 1)];
    if (std::hypot(to.x - from.x, to.y - from.y) > still) {
      psi = std::atan2(to.y - from.y, to.x - from.x);
      if (!known)
        for (std::size_t j = 0; j < k; ++j) rows[j].psi = psi;
      known = true;
    }
    rows[k].psi = psi;
  }
}

std::shared_ptr<const world::Trajectory> trajectory_of(const Value& map,
                                                       const ObstacleEntry& entry) {
  const auto where = map.place.to_string();
  if (const Value* path = map.find("path"))
    return std::make_shared<world::PathTrajectory>(points_of(*path, "a point of a path"),
                                                   entry.speed, entry.acceleration, where);
  const Value* table = map.find("table");
  if (table == nullptr) return nullptr;
  std::vector<world::TrajectoryRow> rows;
  const auto numbers = read_rows(
      *table, {{{"t", "t_s"}}, {{"x", "x_m"}}, {{"y", "y_m"}}, {{"psi", "psi_rad"}, true}},
      "a row of a table");
  for (const auto& row : numbers)
    rows.push_back({row[0], row[1], row[2], row.size() > 3 ? row[3] : 0});
  if (!numbers.empty() && numbers[0].size() < 4) head_along(rows);
  return std::make_shared<world::TableTrajectory>(
      std::move(rows), entry.before, entry.after,
      table->kind == Value::Kind::scalar ? fmt::format("{}: {}", where, table->text) : where);
}

/// Every group of keys that says one thing, of which an obstacle has one.
void require_one(const Value& map, const std::vector<std::vector<const char*>>& ways,
                 const char* what, const char* expected) {
  int said = 0;
  for (const auto& way : ways) {
    std::size_t there = 0;
    for (const char* key : way) there += map.find(key) != nullptr ? 1 : 0;
    if (there == way.size()) {
      ++said;
    } else if (there > 0) {
      throw InvalidValue(map.place.to_string(),
                         fmt::format("an obstacle with {} of {}", there, fmt::join(way, ", ")),
                         "all of them");
    }
  }
  if (said != 1)
    throw InvalidValue(
        map.place.to_string(),
        fmt::format("an obstacle {} {}", said == 0 ? "without" : "with more than one", what),
        expected);
}

void refuse_together(const Value& map, const char* one, std::initializer_list<const char*> others) {
  for (const char* other : others)
    if (map.find(one) != nullptr && map.find(other) != nullptr)
      throw InvalidValue(map.find(other)->place.to_string(),
                         fmt::format("an obstacle with {} and {}", one, other),
                         fmt::format("{} alone, which says where it is", one));
}

void need(const Value& map, const char* key, const char* beside) {
  if (map.find(key) != nullptr && map.find(beside) == nullptr)
    throw InvalidValue(map.find(key)->place.to_string(),
                       fmt::format("an obstacle with {} alone", key),
                       fmt::format("{} beside it", beside));
}

std::string list_of(const std::vector<Point>& points) {
  std::vector<std::vector<double>> rows;
  for (const Point& p : points) rows.push_back({p.x, p.y});
  return yaml_rows(rows);
}

}  // namespace

std::vector<Obstacle> read_obstacles(const Value& map, std::size_t number) {
  require_map(map, "an obstacle (a map with x, y, r, ...)");
  ObstacleEntry entry;
  auto& obstacle = entry.obstacle;
  obstacle.name = fmt::format("O{}", number);
  Places local;
  entry_section(entry).read(map, local, {"polygon", "table", "path"});
  require_one(map, {{"x", "y"}, {"table"}, {"path"}}, "place", "x and y, or a table, or a path");
  require_one(map, {{"r"}, {"a", "b"}, {"length", "width"}, {"polygon"}}, "size",
              "r, or a and b, or length and width, or a polygon");
  for (const char* given : {"table", "path"})
    refuse_together(map, given, {"vx", "vy", "psi", "psi_deg", "repeat"});
  for (const char* key : {"speed", "acceleration"}) need(map, key, "path");
  for (const char* key : {"before", "after"}) need(map, key, "table");
  need(map, "step", "repeat");
  need(map, "path", "speed");
  if (const Value* polygon = map.find("polygon"))
    obstacle.outline = std::make_shared<world::Polygon>(points_of(*polygon, "a corner"),
                                                        polygon->place.to_string());
  else if (map.find("length") != nullptr)
    obstacle.outline =
        std::make_shared<world::Polygon>(world::Polygon::rectangle(entry.length, entry.width));
  if (obstacle.outline) obstacle.a = obstacle.b = obstacle.outline->reach();
  obstacle.trajectory = trajectory_of(map, entry);
  std::vector<Obstacle> result;
  for (int k = 0; k < entry.repeat; ++k) {
    Obstacle one = obstacle;
    one.x += k * entry.step[0];
    one.y += k * entry.step[1];
    if (map.find("repeat") != nullptr) one.name += std::to_string(k + 1);
    result.push_back(std::move(one));
  }
  return result;
}

std::string obstacle_extras(const Obstacle& obstacle) {
  std::string text;
  if (obstacle.outline) text += ", polygon: " + list_of(obstacle.outline->corners());
  const auto* trajectory = obstacle.trajectory.get();
  if (const auto* path = dynamic_cast<const world::PathTrajectory*>(trajectory))
    text += fmt::format(", path: {}, speed: {}, acceleration: {}", list_of(path->points()),
                        yaml_number(path->speed()), yaml_number(path->acceleration()));
  if (const auto* table = dynamic_cast<const world::TableTrajectory*>(trajectory)) {
    std::vector<std::vector<double>> rows;
    for (const auto& row : table->rows()) rows.push_back({row.t, row.x, row.y, row.psi});
    const auto& names = world::beyond_end_names();
    text += fmt::format(", table: {}, before: {}, after: {}", yaml_rows(rows),
                        names[static_cast<std::size_t>(table->before())],
                        names[static_cast<std::size_t>(table->after())]);
  }
  return text;
}

}  // namespace slalom::io
