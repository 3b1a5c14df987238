#include "obstacle_json.hpp"

#include <fmt/format.h>

#include <memory>
#include <utility>

#include "slalom/base/error.hpp"

namespace slalom::io {
namespace {

using world::Obstacle;
using world::Point;
using world::Trajectory;

constexpr int kMostBases = 8;  ///< of trajectories that are made from others

Json json_points(const std::vector<Point>& points) {
  Json json = Json::array();
  for (const auto& p : points) json.push_back(json_numbers({p.x, p.y}));
  return json;
}

Json json_trajectory(const Trajectory& trajectory) {
  Json json;
  if (const auto* table = dynamic_cast<const world::TableTrajectory*>(&trajectory)) {
    json["table"] = Json::array();
    for (const auto& row : table->rows())
      json["table"].push_back(json_numbers({row.t, row.x, row.y, row.psi}));
    json["before"] = world::beyond_end_names()[static_cast<std::size_t>(table->before())];
    json["after"] = world::beyond_end_names()[static_cast<std::size_t>(table->after())];
  } else if (const auto* path = dynamic_cast<const world::PathTrajectory*>(&trajectory)) {
    json["path"] = json_points(path->points());
    json["speed"] = path->speed();
    json["acceleration"] = path->acceleration();
  } else if (const auto* turning = dynamic_cast<const world::TurningTrajectory*>(&trajectory)) {
    const auto& p = turning->pose();
    json["turning"] = json_numbers({turning->t0(), p.x, p.y, p.psi, p.vx, p.vy, p.omega});
  } else if (const auto* offset = dynamic_cast<const world::OffsetTrajectory*>(&trajectory)) {
    json["offset"] = json_numbers({offset->offset().x, offset->offset().y});
    json["base"] = json_trajectory(*offset->base());
  } else if (const auto* moved = dynamic_cast<const world::MovedTrajectory*>(&trajectory)) {
    json["moved"] = json_numbers({moved->by().x, moved->by().y});
    json["base"] = json_trajectory(*moved->base());
  } else if (const auto* retimed = dynamic_cast<const world::RetimedTrajectory*>(&trajectory)) {
    json["retimed"] = json_numbers({retimed->t0(), retimed->factor()});
    json["base"] = json_trajectory(*retimed->base());
  } else {
    throw Error("a trajectory of a kind that no recording has");
  }
  return json;
}

std::vector<double> numbers(const JsonReader& reader, std::size_t count, const char* what) {
  auto list = reader.list();
  if (list.size() != count) reader.refuse(fmt::format("{} numbers", list.size()), what);
  return list;
}

std::vector<Point> points(const JsonReader& reader) {
  std::vector<Point> result;
  for (const auto& row : reader.table(2)) result.push_back({row[0], row[1]});
  return result;
}

world::BeyondEnd beyond_end(const JsonReader& reader) {
  const auto& names = world::beyond_end_names();
  const auto text = reader.text();
  for (std::size_t k = 0; k < names.size(); ++k)
    if (names[k] == text) return static_cast<world::BeyondEnd>(k);
  reader.refuse(text, "stands, goes_on or absent");
}

std::shared_ptr<const Trajectory> trajectory(const JsonReader& reader, int bases = 0) {
  if (bases > kMostBases) reader.refuse("a base of a base of a base ...", "fewer of them");
  if (reader.has("table")) {
    std::vector<world::TrajectoryRow> rows;
    for (const auto& row : reader.at("table").table(4))
      rows.push_back({row[0], row[1], row[2], row[3]});
    return std::make_shared<world::TableTrajectory>(std::move(rows),
                                                    beyond_end(reader.at("before")),
                                                    beyond_end(reader.at("after")), reader.where());
  }
  if (reader.has("path"))
    return std::make_shared<world::PathTrajectory>(
        points(reader.at("path")), reader.at("speed").real(), reader.at("acceleration").real(),
        reader.where());
  if (reader.has("turning")) {
    const auto n = numbers(reader.at("turning"), 7, "t0, x, y, psi, vx, vy, omega");
    return std::make_shared<world::TurningTrajectory>(
        n[0], world::Pose{n[1], n[2], n[3], n[4], n[5], n[6]});
  }
  if (reader.has("retimed")) {
    const auto n = numbers(reader.at("retimed"), 2, "t0, factor");
    return std::make_shared<world::RetimedTrajectory>(trajectory(reader.at("base"), bases + 1),
                                                      n[0], n[1]);
  }
  const bool offset = reader.has("offset");
  const auto by = numbers(reader.at(offset ? "offset" : "moved"), 2, "x, y");
  auto base = trajectory(reader.at("base"), bases + 1);
  if (offset)
    return std::make_shared<world::OffsetTrajectory>(std::move(base), Point{by[0], by[1]});
  return std::make_shared<world::MovedTrajectory>(std::move(base), Point{by[0], by[1]});
}

}  // namespace

Json json_obstacles(const std::vector<Obstacle>& obstacles) {
  Json json = Json::array();
  for (const auto& o : obstacles) {
    Json one = {{"name", o.name}, {"numbers", json_numbers({o.x, o.y, o.a, o.b, o.vx, o.vy})}};
    if (o.psi != 0) one["psi"] = o.psi;
    if (o.outline) one["polygon"] = json_points(o.outline->corners());
    if (o.rounding != 0) one["rounding"] = o.rounding;
    if (o.trajectory) one["trajectory"] = json_trajectory(*o.trajectory);
    if (o.margin_start != 0 || o.margin_rate != 0)
      one["margin"] = json_numbers({o.margin_start, o.margin_rate, o.predicted_at});
    json.push_back(std::move(one));
  }
  return json;
}

std::vector<Obstacle> read_obstacles(const JsonReader& reader) {
  std::vector<Obstacle> result;
  for (std::size_t i = 0; i < reader.size(); ++i) {
    const JsonReader one = reader.at(i);
    const auto n = numbers(one.at("numbers"), 6, "x, y, a, b, vx, vy");
    Obstacle o{one.at("name").text(), n[0], n[1], n[2], n[3], n[4], n[5]};
    if (one.has("psi")) o.psi = one.at("psi").real();
    if (one.has("polygon")) {
      const auto polygon = one.at("polygon");
      o.outline = std::make_shared<world::Polygon>(points(polygon), polygon.where());
    }
    if (one.has("rounding")) o.rounding = one.at("rounding").real();
    if (one.has("trajectory")) o.trajectory = trajectory(one.at("trajectory"));
    if (one.has("margin")) {
      const auto margin = numbers(one.at("margin"), 3, "margin_start, margin_rate, predicted_at");
      o.margin_start = margin[0];
      o.margin_rate = margin[1];
      o.predicted_at = margin[2];
    }
    result.push_back(std::move(o));
  }
  return result;
}

}  // namespace slalom::io
