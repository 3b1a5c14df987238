#include "slalom/sim/drive.hpp"

#include <nanobind/stl/function.h>

#include <exception>
#include <functional>
#include <optional>

#include "answers.hpp"
#include "binding.hpp"
#include "scenario.hpp"
#include "slalom/io/drive_files.hpp"
#include "slalom/io/results_folder.hpp"
#include "slalom/sim/closed_loop.hpp"
#include "slalom/sim/marks.hpp"

namespace slalom::python {
namespace {

using sim::Cycle;
using sim::Drive;
using sim::Scenario;

/// What Python knows as Drive: with the scenario that was driven.
struct Driven {
  Scenario scenario;
  Drive drive;
};

using OnCycle = std::function<void(const Cycle&)>;

Driven simulate(const ScenarioChoice& scenario, const std::optional<std::string>& planner,
                std::optional<double> tex, const ByName<nb::any>& set,
                const std::optional<OnCycle>& on_cycle, const std::optional<std::string>& vehicle) {
  Driven driven{scenario_of(scenario, {planner, tex, set, vehicle}), {}};
  Released released;
  std::exception_ptr thrown;
  sim::LoopHooks hooks;
  hooks.interrupted = [&] { return thrown != nullptr || released.interrupted(); };
  if (on_cycle)
    hooks.on_cycle = [&](const Cycle& cycle) {
      if (thrown) return;
      const nb::gil_scoped_acquire lock;
      try {
        (*on_cycle)(cycle);
      } catch (...) {
        thrown = std::current_exception();  // the drive ends first
      }
    };
  {
    const nb::gil_scoped_release unlock;
    driven.drive = sim::drive(driven.scenario, hooks);
  }
  if (thrown) std::rethrow_exception(thrown);
  released.raise_if_interrupted();
  return driven;
}

template <class Get>
Matrix samples(const Driven& d, std::size_t columns, const Get& get) {
  return table(d.drive.plant, columns, get);
}

void bind_cycle(nb::module_& module) {
  nb::class_<Cycle>(module, "Cycle", doc::sim_Cycle)
      .def_ro("index", &Cycle::index, doc::sim_Cycle_index)
      .def_ro("t0", &Cycle::t0, doc::sim_Cycle_t0)
      .def_ro("tex", &Cycle::tex, doc::sim_Cycle_tex)
      .def_ro("charged", &Cycle::charged, doc::sim_Cycle_charged)
      .def_ro("t_swap", &Cycle::t_swap, doc::sim_Cycle_t_swap)
      .def_prop_ro(
          "X0p",
          [](const Cycle& c) { return to_numpy(std::vector<double>(c.X0p.begin(), c.X0p.end())); },
          nb::rv_policy::move, doc::sim_Cycle_X0p)
      .def_prop_ro(
          "plan", [](const Cycle& c) { return c.plan; }, doc::sim_Cycle_plan)
      .def_ro("used", &Cycle::used, doc::sim_Cycle_used);
}

void bind_outcome(nb::class_<Driven>& type) {
  type.def_ro("scenario", &Driven::scenario, "What was driven.")
      .def_prop_ro(
          "outcome", [](const Driven& d) { return sim::to_string(d.drive.outcome); },
          "goal, crash, wheel_lift, off_road, not_optimal, solve_time, timeout or interrupted.")
      .def_prop_ro(
          "time", [](const Driven& d) { return d.drive.time; }, doc::sim_Drive_time)
      .def_prop_ro(
          "goal_time", [](const Driven& d) { return d.drive.goal_time; }, doc::sim_Drive_goal_time)
      .def_prop_ro(
          "hit", [](const Driven& d) { return d.drive.hit; }, doc::sim_Drive_hit)
      .def_prop_ro(
          "message", [](const Driven& d) { return d.drive.message; }, doc::sim_Drive_message)
      .def_prop_ro(
          "marks",
          [](const Driven& d) {
            std::vector<std::string> texts;
            for (const auto& mark : sim::marks(d.scenario, d.drive))
              texts.push_back(mark.kind + ": " + mark.text);
            return texts;
          },
          "What the outcome does not show, as `slalom simulate` warns of it: the kind, as in "
          "summary.json, ': '\nand a sentence each.")
      .def_prop_ro(
          "least_clearance", [](const Driven& d) { return d.drive.least_clearance; },
          doc::sim_Drive_least_clearance)
      .def_prop_ro(
          "least_wheel_load", [](const Driven& d) { return d.drive.least_wheel_load; },
          doc::sim_Drive_least_wheel_load)
      .def_prop_ro(
          "cycles", [](const Driven& d) { return d.drive.cycles; },
          "The planning cycles, the warm-up solve first if there was one.")
      .def_prop_ro(
          "plans",
          [](const Driven& d) {
            std::vector<planner::Plan> plans;
            for (const auto& cycle : d.drive.cycles) plans.push_back(cycle.plan);
            return plans;
          },
          "The plans of `cycles`.")
      .def("__repr__", [](const Driven& d) { return "<Drive: " + d.drive.message + ">"; });
}

void bind_samples(nb::class_<Driven>& type) {
  type.def_prop_ro(
          "t",
          [](const Driven& d) {
            std::vector<double> t;
            for (const auto& sample : d.drive.plant) t.push_back(sample.t);
            return to_numpy(t);
          },
          nb::rv_policy::move, "Absolute times of the plant's samples [s].")
      .def_prop_ro(
          "states",
          [](const Driven& d) {
            return samples(
                d, vehicle::kStates, [](const auto& s) -> auto& { return s.state; });
          },
          nb::rv_policy::move, "The plant's states, [sample, state], in the order of state_names.")
      .def_prop_ro(
          "controls",
          [](const Driven& d) {
            return samples(
                d, vehicle::kControls, [](const auto& s) -> auto& { return s.control; });
          },
          nb::rv_policy::move,
          "The plant's controls, [sample, control], in the order of control_names.")
      .def_prop_ro(
          "wheel_loads",
          [](const Driven& d) {
            return samples(
                d, vehicle::kWheels, [](const auto& s) -> auto& { return s.wheel_loads; });
          },
          nb::rv_policy::move,
          "Vertical loads [sample, wheel], rear left, rear right, front left, front right [N].")
      .def_prop_ro(
          "clearance",
          [](const Driven& d) {
            std::vector<double> clearance;
            for (const auto& sample : d.drive.plant) clearance.push_back(sample.clearance);
            return to_numpy(clearance);
          },
          nb::rv_policy::move, doc::sim_PlantSample_clearance);
}

}  // namespace

void bind_drive(nb::module_& module) {
  bind_cycle(module);
  nb::class_<Driven> type(module, "Drive", doc::sim_Drive);
  bind_outcome(type);
  bind_samples(type);
  bind_extras(type, "Path and obstacles, and states over time; a Matplotlib figure (extra 'plot').",
              "The plant's samples as a pandas DataFrame over time (extra 'frame').");
  type.def(
      "write",
      [](const Driven& d, const std::filesystem::path& folder, bool force) {
        const io::ResultsFolder held(folder, force);
        io::write_drive(folder, d.scenario, d.drive);
      },
      "folder"_a, nb::kw_only(), "force"_a = false,
      "Writes what `slalom simulate --out` does: tables, the report's page, resolved.yaml. Raises "
      "Error when\nthe folder holds results and not `force`, or another process writes its results "
      "there.");
  module.def(
      "simulate", &simulate, "scenario"_a, nb::kw_only(), "planner"_a = nb::none(),
      "tex"_a = nb::none(), "set"_a = nb::dict(), "on_cycle"_a = nb::none(),
      "vehicle"_a = nb::none(),
      "Drives a scenario in closed loop: one that was loaded, or what load_scenario takes. "
      "`on_cycle` is\ncalled after each planning cycle, with that Cycle; what it raises ends "
      "the drive and comes out\nhere. Raises InvalidValue for what is no scenario; how a "
      "drive fails is its outcome.");
  const std::vector<std::string> states(vehicle::kStateNames.begin(), vehicle::kStateNames.end());
  const std::vector<std::string> controls(vehicle::kControlNames.begin(),
                                          vehicle::kControlNames.end());
  module.attr("state_names") = nb::tuple(nb::cast(states));
  module.attr("control_names") = nb::tuple(nb::cast(controls));
}

}  // namespace slalom::python
