#include "slalom/planner/planner.hpp"

#include <limits>
#include <memory>
#include <optional>
#include <string>

#include "binding.hpp"
#include "scenario.hpp"
#include "settings.hpp"
#include "slalom/base/error.hpp"
#include "slalom/planner/many.hpp"
#include "slalom/vehicle/plant.hpp"

namespace slalom::python {
namespace {

using planner::Plan;
using sim::Scenario;

constexpr double kLongest = 36000;  ///< that a plant is advanced at once [s]

vehicle::State state_of(const std::vector<double>& numbers, const char* where) {
  if (numbers.size() != vehicle::kStates)
    throw InvalidValue(where, std::to_string(numbers.size()) + " numbers",
                       std::to_string(vehicle::kStates) + ", those of state_names");
  vehicle::State state;
  std::copy(numbers.begin(), numbers.end(), state.begin());
  return state;
}

/// A planner with what its scenario says of time.
struct ScenarioPlanner {
  planner::Task task;
  planner::Planner planner;
  double tex;

  explicit ScenarioPlanner(const Scenario& s) : task(s), planner(s), tex(s.loop.tex) {}
};

/// Obstacles as measured at t0, as a request has them: where they would have been at t = 0. Times
/// of tables and paths are the drive's.
std::vector<world::Obstacle> measured_at(double t0, std::vector<world::Obstacle> obstacles) {
  for (std::size_t i = 0; i < obstacles.size(); ++i) {
    auto& o = obstacles[i];
    if (o.name.empty()) o.name = "O" + std::to_string(i + 1);
    world::obstacle_options().check(o, "plan: obstacle " + o.name);
    o.x -= o.vx * t0;
    o.y -= o.vy * t0;
  }
  return obstacles;
}

/// `where` is the call, with the row of it that this is.
planner::Request request_of(const ScenarioPlanner& self, const std::vector<double>& state,
                            const std::string& where, double t0, std::optional<double> tex,
                            double time_limit, double best_iterate_tol) {
  planner::Request request;
  request.X0p = state_of(state, (where + ": state").c_str());
  request.t0 = t0;
  request.t_start = t0 + tex.value_or(self.tex);
  request.time_limit = time_limit;
  request.best_iterate_tol = best_iterate_tol;
  check(request, where);
  return request;
}

Plan plan(ScenarioPlanner& self, const std::vector<double>& state, double t0,
          std::optional<double> tex, double time_limit, double best_iterate_tol,
          const std::optional<std::vector<world::Obstacle>>& obstacles) {
  planner::Request request = request_of(self, state, "plan", t0, tex, time_limit, best_iterate_tol);
  if (obstacles) request.obstacles = measured_at(t0, *obstacles);
  Released released;
  request.interrupted = [&released] { return released.interrupted(); };
  Plan result;
  {
    const nb::gil_scoped_release unlock;
    result = self.planner.plan(request);
  }
  released.raise_if_interrupted();
  return result;
}

/// Each from `state`'s row, as the first plan of a planner made for the scenario.
std::vector<Plan> plan_many(ScenarioPlanner& self, const std::vector<std::vector<double>>& states,
                            double t0, std::optional<double> tex, double time_limit,
                            double best_iterate_tol, int threads) {
  check_at_most(threads, kMostThreads, "plan_many: threads");
  std::vector<planner::Request> requests;
  for (std::size_t i = 0; i < states.size(); ++i)
    requests.push_back(request_of(self, states[i], "plan_many: states[" + std::to_string(i) + "]",
                                  t0, tex, time_limit, best_iterate_tol));
  Released released;
  std::vector<Plan> plans;
  {
    const nb::gil_scoped_release unlock;
    plans = planner::plan_many(self.task, requests, threads,
                               [&released] { return released.interrupted(); });
  }
  released.raise_if_interrupted();
  return plans;
}

void bind_report(nb::class_<Plan>& type) {
  type.def_prop_ro(
          "solved", [](const Plan& p) { return p.report.solved; }, doc::planner_SolveReport_solved)
      .def_prop_ro(
          "status", [](const Plan& p) { return p.report.status_text(); },
          doc::planner_SolveReport_status_text)
      .def_prop_ro(
          "backend", [](const Plan& p) { return p.report.backend; },
          doc::planner_SolveReport_backend)
      .def_prop_ro(
          "iterations", [](const Plan& p) { return p.report.iterations; },
          "The solver's iterations.")
      .def_prop_ro(
          "cost", [](const Plan& p) { return p.report.cost; }, "The sum of the cost terms.")
      .def_prop_ro(
          "cost_terms", [](const Plan& p) { return by_name<double>(p.report.cost_terms); },
          doc::planner_SolveReport_cost_terms)
      .def_prop_ro(
          "worst_violation", [](const Plan& p) { return p.report.worst_violation; },
          doc::planner_SolveReport_worst_violation)
      .def_prop_ro(
          "worst_constraint", [](const Plan& p) { return p.report.worst_constraint; },
          doc::planner_SolveReport_worst_constraint)
      .def_prop_ro(
          "stationarity", [](const Plan& p) { return p.report.stationarity; },
          doc::planner_SolveReport_stationarity)
      .def_prop_ro(
          "wall_s", [](const Plan& p) { return p.report.wall_s; },
          "Seconds by the clock in the solver.")
      .def_prop_ro(
          "used_cpu_s", [](const Plan& p) { return p.report.planning_cpu_s; },
          doc::planner_SolveReport_planning_cpu_s);
}

/// What a planner that verifies says of a plan, and of the others that it looked at.
void bind_verification(nb::module_& module) {
  using planner::Candidate;
  using planner::Certificate;
  nb::class_<Certificate>(module, "Certificate", doc::planner_Certificate)
      .def_ro("verified", &Certificate::verified)
      .def_ro("least_clearance", &Certificate::least_clearance,
              doc::planner_Certificate_least_clearance)
      .def_ro("proved_clearance", &Certificate::proved_clearance,
              doc::planner_Certificate_proved_clearance)
      .def_ro("nearest", &Certificate::nearest, doc::planner_Certificate_nearest)
      .def_ro("least_wheel_load", &Certificate::least_wheel_load,
              doc::planner_Certificate_least_wheel_load)
      .def_ro("until", &Certificate::until, doc::planner_Certificate_until)
      .def_ro("refused", &Certificate::refused, doc::planner_Certificate_refused)
      .def_ro("refused_at", &Certificate::refused_at, doc::planner_Certificate_refused_at)
      .def("__repr__", [](const Certificate& c) {
        return "<Certificate: " + (c.verified ? "verified" : "refused: " + c.refused) + ">";
      });
  nb::class_<Candidate>(module, "Candidate", doc::planner_Candidate)
      .def_ro("name", &Candidate::name, doc::planner_Candidate_name)
      .def_ro("cost", &Candidate::cost, doc::planner_Candidate_cost)
      .def_ro("certificate", &Candidate::certificate)
      .def_prop_ro(
          "path",
          [](const Candidate& c) {
            return table(c.path, 2, [](const world::Point& p) { return std::array{p.x, p.y}; });
          },
          nb::rv_policy::move, doc::planner_Candidate_path)
      .def("__repr__", [](const Candidate& c) { return "<Candidate: " + c.name + ">"; });
}

void bind_plan(nb::module_& module) {
  nb::class_<Plan> type(module, "Plan", doc::planner_Plan);
  type.def_ro("t_start", &Plan::t_start, doc::planner_Plan_t_start)
      .def_ro("tf", &Plan::tf, doc::planner_Plan_tf)
      .def_ro("goal_in_range", &Plan::goal_in_range)
      .def_prop_ro(
          "rung", [](const Plan& p) { return planner::to_string(p.rung); },
          (std::string(doc::planner_Rung) +
           "\nIn a word: new, rest or least_bad; empty for planners that do not verify.")
              .c_str())
      .def_prop_ro(
          "certificate",
          [](const Plan& p) {
            return p.rung == planner::Rung::none ? std::nullopt : std::optional(p.certificate);
          },
          "What is known of it; None for planners that do not verify.")
      .def_ro("candidates", &Plan::candidates, "The motions that were looked at, in that order.")
      .def_prop_ro(
          "fallback", [](const Plan& p) { return planner::fallback(p); },
          nb::rv_policy::reference_internal,
          "What would be driven in place of a new plan: the rest of the last one, a Candidate, if "
          "that is verified too; else None.")
      .def_prop_ro(
          "t", [](const Plan& p) { return to_numpy(p.t); }, nb::rv_policy::move,
          doc::planner_Plan_t)
      .def_prop_ro(
          "states",
          [](const Plan& p) {
            return table(
                p.states, vehicle::kStates, [](const auto& row) -> const auto& { return row; });
          },
          nb::rv_policy::move,
          "The state at each node, [node, state], in the order of state_names.")
      .def_prop_ro(
          "controls",
          [](const Plan& p) {
            return table(
                p.controls, vehicle::kControls, [](const auto& row) -> const auto& { return row; });
          },
          nb::rv_policy::move,
          "The control at each node, [node, control], in the order of control_names.")
      .def("__repr__", [](const Plan& p) {
        return "<Plan: " + p.report.status_text() + ", " + std::to_string(p.t.size()) + " nodes>";
      });
  bind_report(type);
}

void bind_plant(nb::module_& module) {
  using vehicle::Plant;
  nb::class_<Plant>(module, "Plant", doc::vehicle_Plant)
      .def(
          "__init__",
          [](Plant* self, const Scenario& s) {
            new (self) Plant(sim::plant_vehicle(s.vehicle, s.plant, s.name), s.loop.plant_tolerance,
                             s.loop.sample_step);
          },
          "scenario"_a,
          "The plant of a scenario: its vehicle, changed as `plant` says, without actuator delay.")
      .def(
          "advance",
          [](const Plant& plant, const std::vector<double>& state, const Plan* plan, double t0,
             double t1) {
            if (!(t1 >= t0))
              throw InvalidValue("advance", "t1 before t0", "t0 <= t1, absolute times [s]");
            const auto signal = plan ? control_signal(*plan) : vehicle::ControlSignal();
            const auto begin = state_of(state, "advance: state");
            if (!(t1 - t0 <= kLongest))
              throw InvalidValue("advance", std::to_string(t1 - t0) + " s",
                                 "at most " + std::to_string(static_cast<int>(kLongest)) +
                                     " s; t0 and t1 are times of the drive, not of the day");
            Released released;
            vehicle::State end = begin;
            {
              const nb::gil_scoped_release unlock;
              double t = t0;
              for (const double next : plant.instants(signal, t0, t1)) {
                end = plant.advance(end, signal, t, next);
                t = next;
                if (released.interrupted()) break;
              }
            }
            released.raise_if_interrupted();
            return to_numpy(std::vector<double>(end.begin(), end.end()));
          },
          "state"_a, "plan"_a.none(), "t0"_a, "t1"_a, nb::rv_policy::move,
          "The state at t1 from that at t0 [s], driven by a plan's controls; without a plan "
          "straight on at\nconstant speed. At most ten hours. Raises Error where the state leaves "
          "the model's "
          "domain.");
}

}  // namespace

void bind_planner(nb::module_& module) {
  bind_verification(module);
  bind_plan(module);
  bind_plant(module);
  nb::class_<ScenarioPlanner>(module, "Planner", doc::planner_Planner)
      .def(nb::init<const Scenario&>(), "scenario"_a,
           "The planner of a scenario: its settings, vehicle, goal, region and obstacles.")
      .def("plan", &plan, "state"_a, nb::kw_only(), "t0"_a = 0.0, "tex"_a = nb::none(),
           "time_limit"_a = std::numeric_limits<double>::infinity(), "best_iterate_tol"_a = -1.0,
           "obstacles"_a = nb::none(),
           "The plan from `state`, that at t0 + tex [s] in the order of state_names; tex is the "
           "scenario's if\nleft out. A plan whose solve ended otherwise is returned too. "
           "`time_limit` is of thread time "
           "[s]. `obstacles`, if given, take the place of the\nscenario's in this call, as many as "
           "there are: their x and y are those at t0, times of tables and paths the drive's, "
           "and\nthose "
           "of one name are one from call to call.")
      .def("plan_many", &plan_many, "states"_a, nb::kw_only(), "t0"_a = 0.0, "tex"_a = nb::none(),
           "time_limit"_a = std::numeric_limits<double>::infinity(), "best_iterate_tol"_a = -1.0,
           "threads"_a = 0,
           "A plan from each row of `states`, [plan, state], each as the first plan of a planner "
           "just "
           "made: so it\ndepends on its row alone, and neither on this planner's last plan nor on "
           "the number of `threads`\n(0: as many as processors). `time_limit` is of thread time of "
           "each plan [s].")
      .def(
          "reset", [](ScenarioPlanner& self) { self.planner.reset(); }, doc::planner_Planner_reset);
}

}  // namespace slalom::python
