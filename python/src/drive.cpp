#include <map>
#include <string>

#include <nanobind/stl/map.h>

#include "binding.hpp"
#include "slalom/base/error.hpp"
#include "slalom/io/scenario_file.hpp"
#include "slalom/sim/closed_loop.hpp"

namespace slalom::python {
namespace {

using sim::Drive;
using sim::Scenario;

Scenario load(const std::string& name_or_file, const std::optional<std::string>& planner,
              std::optional<double> tex, const std::map<std::string, std::string>& set) {
  io::ScenarioRequest request{name_or_file, planner, tex, {}};
  for (const auto& [key, value] : set) request.overrides.push_back(key + "=" + value);
  return io::load_scenario(request);
}

/// As the command line has it: text, or what Python prints of a number or truth value.
std::map<std::string, std::string> texts(const nb::dict& set) {
  std::map<std::string, std::string> result;
  for (const auto& [key, value] : set)
    result[nb::cast<std::string>(key)] = nb::isinstance<nb::bool_>(value)
                                             ? (nb::cast<bool>(value) ? "true" : "false")
                                             : nb::cast<std::string>(nb::str(value));
  return result;
}

Drive simulate(const nb::object& scenario, const std::optional<std::string>& planner,
               std::optional<double> tex, const ByName<nb::any>& set) {
  const bool loaded = nb::isinstance<Scenario>(scenario);
  if (loaded && (planner || tex || set.size() > 0))
    throw nb::type_error("planner, tex and set belong to load_scenario where a Scenario is given");
  const auto drives = loaded ? nb::cast<Scenario>(scenario)
                             : load(nb::cast<std::string>(scenario), planner, tex, texts(set));
  Released released;
  sim::LoopHooks hooks;
  hooks.interrupted = [&released] { return released.interrupted(); };
  Drive drive;
  {
    const nb::gil_scoped_release unlock;
    drive = sim::drive(drives, hooks);
  }
  released.raise_if_interrupted();
  return drive;
}

Matrix nodes(const planner::Plan& plan) {
  return table(
      plan.states, vehicle::kStates, [](const auto& row) -> const auto& { return row; });
}

void bind_plan(nb::module_& module) {
  using planner::Plan;
  nb::class_<Plan>(module, "Plan", doc::planner_Plan)
      .def_ro("t_start", &Plan::t_start, doc::planner_Plan_t_start)
      .def_ro("tf", &Plan::tf, doc::planner_Plan_tf)
      .def_prop_ro(
          "t", [](const Plan& p) { return to_numpy(p.t); }, nb::rv_policy::move,
          doc::planner_Plan_t)
      .def_prop_ro("states", &nodes, nb::rv_policy::move, "The state at each node, [node, state].")
      .def_prop_ro(
          "controls",
          [](const Plan& p) {
            return table(
                p.controls, vehicle::kControls, [](const auto& row) -> const auto& { return row; });
          },
          nb::rv_policy::move, "The control at each node, [node, control].")
      .def_prop_ro(
          "solved", [](const Plan& p) { return p.report.solved; }, doc::planner_SolveReport_solved)
      .def_prop_ro(
          "status", [](const Plan& p) { return p.report.status; }, doc::planner_SolveReport_status)
      .def_prop_ro("iterations", [](const Plan& p) { return p.report.iterations; })
      .def_prop_ro("cost", [](const Plan& p) { return p.report.cost; })
      .def_prop_ro("wall_s", [](const Plan& p) { return p.report.wall_s; })
      .def_prop_ro(
          "used_cpu_s", [](const Plan& p) { return p.report.planning_cpu_s; },
          doc::planner_SolveReport_planning_cpu_s);
}

void bind_results(nb::module_& module) {
  nb::class_<Drive>(module, "Drive", doc::sim_Drive)
      .def_prop_ro("outcome", [](const Drive& d) { return sim::to_string(d.outcome); })
      .def_ro("time", &Drive::time, doc::sim_Drive_time)
      .def_ro("goal_time", &Drive::goal_time, doc::sim_Drive_goal_time)
      .def_ro("hit", &Drive::hit, doc::sim_Drive_hit)
      .def_ro("message", &Drive::message, doc::sim_Drive_message)
      .def_ro("least_clearance", &Drive::least_clearance, doc::sim_Drive_least_clearance)
      .def_ro("least_wheel_load", &Drive::least_wheel_load, doc::sim_Drive_least_wheel_load)
      .def_prop_ro(
          "t",
          [](const Drive& d) {
            std::vector<double> t;
            for (const auto& sample : d.plant) t.push_back(sample.t);
            return to_numpy(t);
          },
          nb::rv_policy::move, "Absolute times of the plant's samples [s].")
      .def_prop_ro(
          "states",
          [](const Drive& d) {
            return table(
                d.plant, vehicle::kStates, [](const auto& s) -> const auto& { return s.state; });
          },
          nb::rv_policy::move, "The plant's states, [sample, state], in the order of state_names.")
      .def_prop_ro(
          "controls",
          [](const Drive& d) {
            return table(
                d.plant, vehicle::kControls,
                [](const auto& s) -> const auto& { return s.control; });
          },
          nb::rv_policy::move,
          "The plant's controls, [sample, control], in the order of control_names.")
      .def_prop_ro(
          "wheel_loads",
          [](const Drive& d) {
            return table(
                d.plant, vehicle::kWheels,
                [](const auto& s) -> const auto& { return s.wheel_loads; });
          },
          nb::rv_policy::move,
          "Vertical loads [sample, wheel], rear left, rear right, front left, front "
          "right [N].")
      .def_prop_ro(
          "plans",
          [](const Drive& d) {
            std::vector<planner::Plan> plans;
            for (const auto& cycle : d.cycles) plans.push_back(cycle.plan);
            return plans;
          },
          "One plan a cycle, the warm-up solve first if there was one.");
}

}  // namespace

void bind_planner(nb::module_& module) {
  nb::class_<Scenario>(module, "Scenario", doc::sim_Scenario)
      .def_ro("name", &Scenario::name)
      .def_ro("title", &Scenario::title)
      .def_prop_ro(
          "start",
          [](const Scenario& s) {
            return to_numpy(std::vector<double>(s.start.begin(), s.start.end()));
          },
          nb::rv_policy::move, "The state at the start, in the order of state_names.")
      .def(
          "to_yaml", [](const Scenario& s) { return io::to_yaml(s); }, doc::io_to_yaml);
  module.def(
      "load_scenario",
      [](const std::string& name_or_file, const std::optional<std::string>& planner,
         std::optional<double> tex,
         const ByName<nb::any>& set) { return load(name_or_file, planner, tex, texts(set)); },
      "name_or_file"_a, nb::kw_only(), "planner"_a = nb::none(), "tex"_a = nb::none(),
      "set"_a = nb::dict(), doc::io_load_scenario);
  module.def(
      "scenario_names",
      [] {
        std::vector<std::string> names;
        for (const auto& each : io::built_in_scenarios()) names.push_back(each.name);
        return names;
      },
      "The names of the built-in scenarios.");
  bind_plan(module);
}

void bind_drive(nb::module_& module) {
  bind_results(module);
  module.def("simulate", &simulate, "scenario"_a, nb::kw_only(), "planner"_a = nb::none(),
             "tex"_a = nb::none(), "set"_a = nb::dict(),
             "Drives a scenario, or that of a built-in name or file, in closed loop; `set` changes "
             "values\nby key, such as {\"planner.w_t\": 50}. Raises InvalidValue for a scenario "
             "that is not one; how\na drive fails is its outcome.");
  const std::vector<std::string> states(vehicle::kStateNames.begin(), vehicle::kStateNames.end());
  const std::vector<std::string> controls(vehicle::kControlNames.begin(),
                                          vehicle::kControlNames.end());
  module.attr("state_names") = nb::tuple(nb::cast(states));
  module.attr("control_names") = nb::tuple(nb::cast(controls));
}

}  // namespace slalom::python
