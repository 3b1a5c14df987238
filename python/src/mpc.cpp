#include "slalom/ocp/mpc.hpp"

#include <nanobind/stl/function.h>
#include <nanobind/stl/map.h>
#include <algorithm>

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include "binding.hpp"
#include "running.hpp"
#include "settings.hpp"
#include "slalom/base/error.hpp"
#include "slalom/base/options.hpp"
#include "solved.hpp"

namespace slalom::python {
namespace {

using ocp::MpcCycle;
using ocp::MpcResult;
using ocp::MpcSettings;
using ocp::Problem;

/// The problem of each cycle as it was solved, by the cycle's index.
using Problems = std::map<int, std::shared_ptr<const Problem>>;

/// The problem of a cycle; a warm-up solves that of the first.
const std::shared_ptr<const Problem>& problem_of(const Problems& problems, int index) {
  return problems.at(std::max(index, 1));
}

/// What Python knows as MpcCycle.
struct Cycle {
  MpcCycle cycle;
  std::shared_ptr<const Problem> problem;
};

/// What Python knows as MpcResult.
struct Run {
  MpcResult result;
  Problems problems;
};

using Update = std::function<void(nb::handle_t<Problem>, Cycle)>;
using Check = std::function<std::optional<std::string>(Cycle)>;
using Measure = std::function<std::vector<double>(Vector)>;

/// A loop with what its callbacks need.
class Loop {
  /// Lets other threads run meanwhile, and hears an interrupt between and in solves.
  template <class Work>
  auto call(const Work& work) {
    Released released;
    released_ = &released;
    const auto forget = [this](void*) { released_ = nullptr; };
    const std::unique_ptr<void, decltype(forget)> at_end(this, forget);
    auto result = [&] {
      const nb::gil_scoped_release unlock;
      return work();
    }();
    released.raise_if_interrupted();
    return result;
  }

 public:
  Loop(const Problem& problem, MpcSettings settings, const std::optional<Update>& update,
       const std::optional<Check>& check)
      : keep_cycles_(settings.keep_cycles) {
    settings.update = [this, update](Problem& now, const MpcCycle& cycle) {
      if (update) call_update(*update, now, cycle);
      if (!keep_cycles_) problems_.clear();
      problems_[cycle.index] = std::make_shared<const Problem>(now);
    };
    if (check)
      settings.check = [this, check](const MpcCycle& cycle) {
        const nb::gil_scoped_acquire lock;
        return (*check)({cycle, problem_of(problems_, cycle.index)}).value_or("");
      };
    settings.solve.options.stop = [](void* self) {
      auto* released = static_cast<Loop*>(self)->released_;
      return released != nullptr && released->interrupted();
    };
    settings.solve.options.stop_data = this;
    mpc_ = std::make_unique<ocp::Mpc>(problem, std::move(settings));
  }
  Loop(const Loop&) = delete;
  Loop& operator=(const Loop&) = delete;

  Run run(const std::vector<double>& x0, double t0) {
    auto result = call([&] { return mpc_->run(x0, t0); });
    for (auto& cycle : result.cycles) forget_stop(cycle.solution.options);
    return {std::move(result), problems_};
  }
  ocp::MpcStatus step(const std::vector<double>& measured, double time) {
    return call([&] { return mpc_->step(measured, time); });
  }
  std::vector<Cycle> cycles() const {
    std::vector<Cycle> list;
    for (const auto& cycle : mpc_->cycles()) {
      list.push_back({cycle, problem_of(problems_, cycle.index)});
      forget_stop(list.back().cycle.solution.options);
    }
    return list;
  }
  const ocp::Mpc& mpc() const { return *mpc_; }

 private:
  static void call_update(const Update& update, Problem& now, const MpcCycle& cycle) {
    const nb::gil_scoped_acquire lock;
    // A copy, for Python may keep it beyond the loop's life.
    const nb::object problem = nb::cast(now, nb::rv_policy::copy);
    update(nb::handle_t<Problem>(problem), {cycle, std::make_shared<const Problem>(now)});
    now = nb::cast<const Problem&>(problem);
  }
  bool keep_cycles_;
  Problems problems_;
  Released* released_ = nullptr;
  std::unique_ptr<ocp::Mpc> mpc_;
};

/// Takes the loop's own options out of the keywords; the others are the solver's.
void set_options(MpcSettings& settings, nb::kwargs& given) {
  const auto& table = ocp::mpc_options();
  for (const auto& entry : table.entries()) {
    const char* name = entry.info.name.c_str();
    if (!given.contains(name)) continue;
    table.set(settings, entry, option_value(given[name], entry.info.name),
              "Mpc: " + entry.info.name);
    nb::del(given[name]);
  }
}

std::vector<std::string> option_names() {
  std::vector<std::string> names{"plant", "goal", "update", "check", "measure", "first_controls"};
  for (const auto& entry : ocp::mpc_options().entries()) names.push_back(entry.info.name);
  return names;
}

void make(Loop* self, const Problem& problem, const MeshChoice& mesh, const SchemeChoice& scheme,
          const PointsChoice& points, const std::string& backend, const nb::object& guess,
          const std::map<std::string, std::pair<double, double>>& goal, const Problem* plant,
          const std::map<std::string, double>& start_tolerance,
          const std::vector<double>& first_controls, const std::optional<Measure>& measure,
          const std::optional<Update>& update, const std::optional<Check>& check,
          const nb::kwargs& options) {
  MpcSettings settings;
  nb::kwargs solver = nb::borrow<nb::kwargs>(options.attr("copy")());
  set_options(settings, solver);
  settings.solve =
      settings_of(problem, {mesh, scheme, points}, backend, guess, nullptr, solver, option_names());
  for (const auto& [state, where] : goal)
    settings.goal.push_back({state, where.first, where.second});
  if (plant != nullptr) settings.plant = ocp::system_of(*plant);
  settings.start_tolerance = start_tolerance;
  settings.first_controls = first_controls;
  if (measure)
    settings.measure = [measure](std::span<const double> plant) {
      const nb::gil_scoped_acquire lock;
      return (*measure)(to_numpy({plant.begin(), plant.end()}));
    };
  new (self) Loop(problem, std::move(settings), update, check);
}

Solved solution(const Cycle& c) {
  Solved solved;
  solved.problem = c.problem;
  solved.answer = c.cycle.solution;
  solved.elapsed_s = c.cycle.solution.wall_s;
  return solved;
}

void bind_cycle(nb::module_& module) {
  const auto numbers = [](std::vector<double> MpcCycle::*member) {
    return [member](const Cycle& c) { return to_numpy(c.cycle.*member); };
  };
  nb::class_<Cycle>(module, "MpcCycle", doc::ocp_MpcCycle)
      .def_prop_ro(
          "index", [](const Cycle& c) { return c.cycle.index; }, doc::ocp_MpcCycle_index)
      .def_prop_ro(
          "t", [](const Cycle& c) { return c.cycle.t; }, doc::ocp_MpcCycle_t)
      .def_prop_ro(
          "t_plan", [](const Cycle& c) { return c.cycle.t_plan; }, doc::ocp_MpcCycle_t_plan)
      .def_prop_ro(
          "t_swap", [](const Cycle& c) { return c.cycle.t_swap; }, doc::ocp_MpcCycle_t_swap)
      .def_prop_ro("measured", numbers(&MpcCycle::measured), nb::rv_policy::move,
                   doc::ocp_MpcCycle_measured)
      .def_prop_ro("x0", numbers(&MpcCycle::x0), nb::rv_policy::move, doc::ocp_MpcCycle_x0)
      .def_prop_ro("solution", &solution, "Not solved yet in `update`.")
      .def_prop_ro(
          "used", [](const Cycle& c) { return c.cycle.used; }, doc::ocp_MpcCycle_used)
      .def_prop_ro("arrived", numbers(&MpcCycle::arrived), nb::rv_policy::move,
                   doc::ocp_MpcCycle_arrived);
}

ByName<Vector> columns(const std::vector<std::string>& names,
                       const std::vector<std::vector<double>>& rows) {
  nb::dict result;
  for (std::size_t i = 0; i < names.size(); ++i) {
    std::vector<double> column;
    for (const auto& row : rows) column.push_back(row[i]);
    result[names[i].c_str()] = to_numpy(column);
  }
  return result;
}

void bind_result(nb::module_& module) {
  nb::class_<Run>(module, "MpcResult", doc::ocp_MpcResult)
      .def_prop_ro(
          "status", [](const Run& r) { return ocp::to_string(r.result.status); },
          doc::ocp_MpcStatus)
      .def_prop_ro(
          "message", [](const Run& r) { return r.result.message; }, doc::ocp_MpcResult_message)
      .def_prop_ro(
          "cycles",
          [](const Run& r) {
            std::vector<Cycle> list;
            for (const auto& cycle : r.result.cycles)
              list.push_back({cycle, problem_of(r.problems, cycle.index)});
            return list;
          },
          "One record for each cycle.")
      .def_prop_ro(
          "t", [](const Run& r) { return to_numpy(r.result.t); }, nb::rv_policy::move,
          doc::ocp_MpcResult_t)
      .def_prop_ro(
          "states", [](const Run& r) { return columns(r.result.plant_states, r.result.states); },
          "The plant's states by name, one number for each sample.")
      .def_prop_ro(
          "controls",
          [](const Run& r) { return columns(r.result.plant_controls, r.result.controls); },
          "The plant's controls by name, one number for each sample.")
      .def("__repr__", [](const Run& r) {
        return "<MpcResult: " + std::string(ocp::to_string(r.result.status)) + " after " +
               std::to_string(r.result.cycles.size()) + " cycles>";
      });
}

}  // namespace

void bind_mpc(nb::module_& module) {
  bind_cycle(module);
  bind_result(module);
  static const std::string keywords = [] {
    std::string text =
        "`mesh`, `scheme`, `points`, `backend`, `guess` and the solver's options are those of "
        "Problem.solve.\n`goal` has by state a value and a tolerance; `plant` is the problem whose "
        "dynamics run() drives,\nthe same if left out; `start_tolerance` by state how far a plan "
        "may begin from where it should;\n`first_controls` hold until the first plan does. "
        "`measure(states)` gives the problem's states, in their order, from an\narray of the "
        "plant's; left out, they are those of the same names. `update(problem, cycle)` is "
        "called\nbefore each solve and may change the problem's numbers, `check(cycle)` after it "
        "and may return a\nreason to stop.\n";
    for (const auto& entry : ocp::mpc_options().entries())
      text += "\n- " + entry.info.name + ": " + entry.info.doc;
    return text;
  }();
  nb::class_<Loop>(module, "Mpc", doc::ocp_Mpc)
      .def("__init__", &make, "problem"_a, nb::kw_only(), "mesh"_a = 40,
           "scheme"_a = "hermite_simpson", "points"_a = nb::none(), "backend"_a = "",
           "guess"_a = nb::none(), "goal"_a = std::map<std::string, std::pair<double, double>>(),
           "plant"_a = nb::none(), "start_tolerance"_a = std::map<std::string, double>(),
           "first_controls"_a = std::vector<double>(), "measure"_a = nb::none(),
           "update"_a = nb::none(), "check"_a = nb::none(), "options"_a, keywords.c_str())
      .def("run", &Loop::run, "x0"_a, "t0"_a = 0.0, doc::ocp_Mpc_run)
      .def(
          "step",
          [](Loop& loop, const std::vector<double>& measured, double time) {
            return ocp::to_string(loop.step(measured, time));
          },
          "measured"_a, "time"_a, doc::ocp_Mpc_step)
      .def(
          "controls", [](const Loop& l, double time) { return to_numpy(l.mpc().controls(time)); },
          "time"_a, nb::rv_policy::move, doc::ocp_Mpc_controls)
      .def_prop_ro(
          "plan_end", [](const Loop& l) { return l.mpc().plan_end(); }, doc::ocp_Mpc_plan_end)
      .def_prop_ro(
          "status", [](const Loop& l) { return ocp::to_string(l.mpc().status()); },
          doc::ocp_MpcStatus)
      .def_prop_ro(
          "message", [](const Loop& l) { return l.mpc().message(); }, doc::ocp_Mpc_message)
      .def_prop_ro("cycles", &Loop::cycles, "One record for each cycle.");
}

}  // namespace slalom::python
