#include "scenario.hpp"

#include <array>
#include <functional>
#include <utility>

#include "slalom/base/error.hpp"
#include "slalom/io/scenario_file.hpp"
#include "slalom/sim/advice.hpp"
#include "solved.hpp"

namespace slalom::python {
namespace {

using sim::Scenario;

/// As the text of a file: JSON, which is YAML but for pairs of surrogates, so that it has its
/// letters as they are; arrays and NumPy's numbers by their tolist().
std::string text_of(const nb::object& value) {
  const nb::object plain =
      nb::cpp_function([](const nb::object& other) { return nb::object(other.attr("tolist")()); });
  const nb::object text = nb::module_::import_("json").attr("dumps")(value, "default"_a = plain,
                                                                     "ensure_ascii"_a = false);
  // By bytes: half a pair is an error that says so.
  const auto bytes = nb::cast<nb::bytes>(text.attr("encode")());
  return {bytes.c_str(), bytes.size()};
}

/// Whether text_of() has it, but for what it holds.
bool has_text(const nb::object& value) {
  return value.is_none() || nb::isinstance<nb::bool_>(value) || nb::isinstance<nb::int_>(value) ||
         nb::isinstance<nb::float_>(value) || nb::isinstance<nb::list>(value) ||
         nb::isinstance<nb::tuple>(value) || nb::isinstance<nb::dict>(value) ||
         nb::hasattr(value, "tolist");
}

io::ScenarioRequest request_of(const std::string& source, const Changes& changes) {
  io::ScenarioRequest request{source, changes.planner, changes.tex, {}, changes.vehicle};
  for (const auto& [key, value] : changes.set) {
    // As the command line has it: text as it stands, what a dict may hold as it would have it.
    const nb::object object = nb::borrow(value);
    const bool is_text = nb::isinstance<nb::str>(object);
    const auto text =
        !is_text && has_text(object) ? text_of(object) : nb::cast<std::string>(nb::str(object));
    request.overrides.push_back(as<std::string>(key, "set", "keys such as 'planner.w_t'") + "=" +
                                text);
  }
  return request;
}

std::vector<std::string> keys(const Scenario& scenario) {
  std::vector<std::string> names;
  for (const auto& [key, value] : io::values_of(scenario)) names.push_back(key);
  return names;
}

nb::any value(const Scenario& scenario, const std::string& wanted) {
  for (const auto& [key, value] : io::values_of(scenario))
    if (key == wanted)
      return std::visit([](const auto& v) { return nb::borrow<nb::any>(nb::cast(v)); }, value);
  const auto nearest = nearest_name(wanted, keys(scenario));
  throw UnknownName(
      {"scenario", "no value '" + wanted + "'",
       nearest.empty() ? "a key such as 'planner.w_t'" : "perhaps '" + nearest + "'"});
}

void bind_parts(nb::module_& module) {
  using world::Goal;
  using world::Region;
  nb::class_<Goal>(module, "Goal", doc::world_Goal)
      .def_ro("x", &Goal::x)
      .def_ro("y", &Goal::y)
      .def_ro("psi", &Goal::psi)
      .def_ro("sigma", &Goal::sigma);
  nb::class_<Region>(module, "Region", doc::world_Region)
      .def_ro("x_min", &Region::x_min)
      .def_ro("x_max", &Region::x_max)
      .def_ro("y_min", &Region::y_min)
      .def_ro("y_max", &Region::y_max);
}

/// Sets a key of `map` unless it is not given.
template <class T>
void put(nb::dict& map, const char* key, const std::optional<T>& value) {
  if (value) map[key] = nb::cast(*value);
}

void bind_obstacle(nb::module_& module) {
  using world::Obstacle;
  using Number = std::optional<double>;
  using Text = std::optional<std::string>;
  using List = std::optional<nb::any>;
  nb::class_<Obstacle>(module, "Obstacle", doc::world_Obstacle)
      .def(
          "__init__",
          [](Obstacle* self, Number x, Number y, Number r, Number a, Number b, Number length,
             Number width, const List& polygon, double psi, double vx, double vy, const List& table,
             const Text& before, const Text& after, const List& path, Number speed,
             Number acceleration, double margin_start, double margin_rate,
             const std::string& name) {
            nb::dict map;
            for (const auto& [key, value] : {std::pair<const char*, Number>{"x", x},
                                             {"y", y},
                                             {"r", r},
                                             {"a", a},
                                             {"b", b},
                                             {"length", length},
                                             {"width", width},
                                             {"speed", speed},
                                             {"acceleration", acceleration}})
              put(map, key, value);
            for (const auto& [key, value] : {std::pair{"psi", psi}, {"vx", vx}, {"vy", vy}})
              if (value != 0) map[key] = value;
            put(map, "polygon", polygon);
            put(map, "table", table);
            put(map, "before", before);
            put(map, "after", after);
            put(map, "path", path);
            map["margin_start"] = margin_start;
            map["margin_rate"] = margin_rate;
            auto obstacle = io::parse_obstacle(text_of(map), "Obstacle");
            obstacle.name = name;
            new (self) Obstacle(std::move(obstacle));
          },
          nb::kw_only(), "x"_a = nb::none(), "y"_a = nb::none(), "r"_a = nb::none(),
          "a"_a = nb::none(), "b"_a = nb::none(), "length"_a = nb::none(), "width"_a = nb::none(),
          "polygon"_a = nb::none(), "psi"_a = 0.0, "vx"_a = 0.0, "vy"_a = 0.0,
          "table"_a = nb::none(), "before"_a = nb::none(), "after"_a = nb::none(),
          "path"_a = nb::none(), "speed"_a = nb::none(), "acceleration"_a = nb::none(),
          "margin_start"_a = 0.0, "margin_rate"_a = 0.0, "name"_a = "",
          "One to plan with, by the keys of a scenario file. Its place: x and y [m] with the "
          "velocity vx, vy [m/s]; or a\ntable of [t, x, y, psi] in s, m and rad; or a path of "
          "[x, y] that it goes along at a speed [m/s]. Its size: a\nradius r; semi-axes a and b; "
          "length and width; or the corners [x, y] of a convex polygon about its place [m].\npsi "
          "turns it [rad]. Lists may be arrays, or names of CSV files. Raises InvalidValue.")
      .def_ro("name", &Obstacle::name)
      .def_ro("x", &Obstacle::x, doc::world_Obstacle_x)
      .def_ro("y", &Obstacle::y, doc::world_Obstacle_y)
      .def_ro("a", &Obstacle::a, doc::world_Obstacle_a)
      .def_ro("b", &Obstacle::b, doc::world_Obstacle_b)
      .def_ro("vx", &Obstacle::vx, doc::world_Obstacle_vx)
      .def_ro("vy", &Obstacle::vy, doc::world_Obstacle_vy)
      .def_ro("psi", &Obstacle::psi, doc::world_Obstacle_psi)
      .def_ro("margin_start", &Obstacle::margin_start, doc::world_Obstacle_margin_start)
      .def_ro("margin_rate", &Obstacle::margin_rate, doc::world_Obstacle_margin_rate)
      .def_prop_ro(
          "outline",
          [](const Obstacle& o) -> std::optional<std::vector<std::array<double, 2>>> {
            if (!o.outline) return std::nullopt;
            std::vector<std::array<double, 2>> corners;
            for (const auto& p : o.outline->corners()) corners.push_back({p.x, p.y});
            return corners;
          },
          "Corners (x, y) [m] of a polygon in the body's own frame, counter-clockwise; None: an "
          "ellipse.")
      .def(
          "corners_at",
          [](const Obstacle& o, double t) {
            return table(o.corners_at(t), 2, [](const world::Point& p) {
              return std::array<double, 2>{p.x, p.y};
            });
          },
          "t"_a, nb::rv_policy::move,
          "Corners of a polygon in the world's frame at the absolute time t [s], [corner, x or y] "
          "[m]; none\nof an ellipse.")
      .def(
          "pose_at",
          [](const Obstacle& o, double t) {
            const auto pose = o.pose_at(t);
            return std::array<double, 6>{pose.x, pose.y, pose.psi, pose.vx, pose.vy, pose.omega};
          },
          "t"_a,
          "Where it is at the absolute time t [s]: x, y [m], psi [rad], vx, vy [m/s], omega "
          "[rad/s]. "
          "Where it\nis absent, where it last was or first will be.")
      .def(
          "present", [](const Obstacle& o, double t) { return o.present(t, t); }, "t"_a,
          "Whether it is there at the absolute time t [s].")
      .def(
          "distance",
          [](const Obstacle& o, double x, double y, double t) {
            return world::distance(o, x, y, t);
          },
          "x"_a, "y"_a, "t"_a = 0.0, doc::world_distance);
}

void bind_class(nb::module_& module) {
  nb::class_<Scenario>(module, "Scenario", doc::sim_Scenario)
      .def_ro("name", &Scenario::name)
      .def_ro("title", &Scenario::title)
      .def_prop_ro(
          "start",
          [](const Scenario& s) {
            return to_numpy(std::vector<double>(s.start.begin(), s.start.end()));
          },
          nb::rv_policy::move, "The state at the start, in the order of state_names.")
      .def_ro("goal", &Scenario::goal)
      .def_ro("region", &Scenario::region)
      .def_prop_ro(
          "obstacles", [](const Scenario& s) { return s.obstacles; },
          "The obstacles, in the file's order.")
      .def_prop_ro(
          "road", [](const Scenario& s) { return s.road.get(); }, nb::rv_policy::reference_internal,
          nb::sig("def road(self) -> Road | None"), "The road to stay on; None without one.")
      .def("keys", &keys, "Keys of all values, as `set=` takes them.")
      .def("__getitem__", &value, "key"_a,
           "A value by its key, such as \"planner.w_t\", \"start.ux\" or \"obstacles.lorry.b\".")
      .def(
          "replace",
          [](const Scenario& s, const std::optional<std::string>& planner,
             std::optional<double> tex, const ByName<nb::any>& set,
             const std::optional<std::string>& vehicle) {
            return scenario_of(s, {planner, tex, set, vehicle});
          },
          nb::kw_only(), "planner"_a = nb::none(), "tex"_a = nb::none(), "set"_a = nb::dict(),
          "vehicle"_a = nb::none(),
          "The scenario with another planner, execution horizon [s], vehicle or other values by "
          "key, checked anew.")
      .def(
          "advice",
          [](const Scenario& s) {
            const nb::gil_scoped_release unlock;
            return sim::advice(s);
          },
          "What is likely to go wrong in a drive of it, in a sentence each, as `slalom check` "
          "notes it. Takes\nup to a second.")
      .def(
          "to_yaml", [](const Scenario& s) { return io::to_yaml(s); }, doc::io_to_yaml)
      .def("__repr__", [](const Scenario& s) {
        return "<Scenario " + s.name + ": " + std::to_string(s.obstacles.size()) +
               " obstacles, planner " + s.planner.name + ">";
      });
}

template <class List>
std::vector<std::string> names_of(const List& files) {
  std::vector<std::string> names;
  for (const auto& each : files) names.push_back(each.name);
  return names;
}

}  // namespace

Scenario scenario_of(const ScenarioChoice& choice, const Changes& changes) {
  if (const auto* loaded = std::get_if<Scenario>(&choice)) {
    if (changes.none()) return *loaded;
    return io::parse_scenario(io::to_yaml_as_stated(*loaded),
                              request_of("scenario " + loaded->name, changes));
  }
  if (const auto* dictionary = std::get_if<ByName<nb::any>>(&choice))
    return io::parse_scenario(text_of(*dictionary), request_of("scenario", changes));
  return io::load_scenario(request_of(std::get<std::filesystem::path>(choice).string(), changes));
}

void bind_scenario(nb::module_& module) {
  bind_parts(module);
  bind_road(module);
  bind_obstacle(module);
  bind_class(module);
  module.def(
      "load_scenario",
      [](const ScenarioChoice& scenario, const std::optional<std::string>& planner,
         std::optional<double> tex, const ByName<nb::any>& set,
         const std::optional<std::string>& vehicle) {
        return scenario_of(scenario, {planner, tex, set, vehicle});
      },
      "scenario"_a, nb::kw_only(), "planner"_a = nb::none(), "tex"_a = nb::none(),
      "set"_a = nb::dict(), "vehicle"_a = nb::none(),
      "Reads and checks a scenario: that of a built-in name, of a file, or a dict with a file's "
      "keys.\n`planner` and `vehicle` are names of built-in ones or files, `tex` the execution "
      "horizon [s], `set`\nchanges values by key, such as {\"planner.w_t\": 50}. Raises "
      "InvalidValue with file, "
      "line and column, what\nwas found and what was expected.");
  module.def(
      "scenario_names", [] { return names_of(io::built_in_scenarios()); },
      "The names of the built-in scenarios.");
  module.def(
      "vehicle_names", [] { return names_of(io::built_in_vehicles()); },
      "The names of the built-in vehicles.");
  module.def(
      "planner_names", [] { return names_of(io::built_in_planners()); },
      "The names of the built-in planners.");
}

}  // namespace slalom::python
