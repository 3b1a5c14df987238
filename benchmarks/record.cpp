// Records planning cycles of planner P_D in closed loop, from seeded starts, failures kept.
//
//   bench_record --environment E_C --out FILE [--cycles 1000] [--perturbed 250] [--seed 1]
//                [--backends ipopt,interior_point]
//
// Each back end drives at tex .5 and .1 s until its share of the cycles is there; the perturbed
// cycles are recorded ones with another predicted state.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <iostream>
#include <string>
#include <vector>

#include "command_line.hpp"
#include "cycle_file.hpp"
#include "slalom/base/error.hpp"
#include "slalom/nlp/check.hpp"
#include "slalom/sim/closed_loop.hpp"

namespace {

using namespace slalom;
using bench::Cycle;

struct Arguments {
  std::string environment = "E_C", out;
  std::size_t cycles = 1000, perturbed = 250;
  std::uint64_t seed = 1;
  std::vector<std::string> backends = {"ipopt", "interior_point"};
};

/// Half-widths of what is added to the start of a drive; SI.
constexpr vehicle::State kStartSpread = {0.3, 0.3, 0, 0, 0.0175, 0, 1, 0};

/// The planner as the closed loop knows it, with every cycle kept.
class Recorder {
 public:
  Recorder(const Arguments& arguments, const std::string& backend, double tex)
      : planner_(bench::load(arguments.environment, tex)),
        seed_(arguments.seed),
        solver_(nlp::make_solver(backend)) {}

  /// Drives until `wanted` cycles are there or drives bring no more.
  void run(std::size_t wanted, int& drives, std::vector<Cycle>& all) {
    const std::size_t begin = all.size();
    for (std::size_t before = all.size(); all.size() - begin < wanted; before = all.size()) {
      sim::Scenario scenario = planner_.scenario();
      scenario.start =
          bench::moved(scenario.start, kStartSpread, seed_, static_cast<std::uint64_t>(drives));
      scenario.loop.on_failure = sim::OnFailure::last_plan;
      scenario.loop.warm_up = false;
      last_.reset();
      const auto plan = [&](const planner::Request& request) {
        all.push_back(make_cycle(request, drives));
        return solve(all.back());
      };
      const auto drive = sim::drive(scenario, plan);
      std::cerr << fmt::format("{} drive {}: {} after {} cycles\n", scenario.name, drives,
                               sim::to_string(drive.outcome), all.size() - before);
      ++drives;
      if (all.size() == before) return;
    }
    thin(wanted, begin, all);
  }

  /// Keeps `wanted` of the cycles from `begin` on, the first few in a row (the growth study drives
  /// them one after the other), the others evenly spaced.
  static void thin(std::size_t wanted, std::size_t begin, std::vector<Cycle>& all) {
    const std::size_t have = all.size() - begin, row = std::min<std::size_t>(wanted / 2, 16);
    if (have <= wanted) return;
    for (std::size_t i = row; i < wanted; ++i)
      all[begin + i] = all[begin + row + (i - row) * (have - row) / (wanted - row)];
    all.resize(begin + wanted);
  }

  Cycle make_cycle(const planner::Request& request, int drive) {
    Cycle cycle;
    cycle.request = request;
    cycle.request.interrupted = nullptr;
    cycle.drive = drive;
    cycle.last = last_;
    bench::place_starts(planner_, cycle);
    return cycle;
  }

 private:
  planner::Plan solve(Cycle& cycle) {
    bench::Form& form = planner_.form(cycle.in_range);
    const auto& settings = planner_.scenario().planner;
    nlp::Options options;
    options.floor = settings.floor;
    options.max_iterations = settings.max_iterations;
    const Last* last = cycle.last ? &*cycle.last : nullptr;
    form.update(cycle.request);
    nlp::Start start;
    planner_.start(cycle.request, last, start);
    options.warm_start = !start.y.empty();
    nlp::Answer answer = solver_->solve(form.transcription, start, options);
    cycle.solved = answer.status == nlp::Status::solved &&
                   nlp::check(form.transcription, answer.point, options).solved(options);
    auto trajectory = form.transcription.trajectory(answer.point.x);
    planner::Plan plan = plan_of(cycle, trajectory);
    if (cycle.solved) {
      answer.point.x.clear();
      last_ = Last{{plan.t_start, cycle.request.X0p, std::move(trajectory), cycle.in_range},
                   std::move(answer.point)};
    }
    return plan;
  }

  static planner::Plan plan_of(const Cycle& cycle, const ocp::Trajectory& trajectory) {
    planner::Plan plan;
    plan.t_start = cycle.request.t_start;
    plan.tf = trajectory.tf;
    plan.goal_in_range = cycle.in_range;
    plan.report.solved = cycle.solved;
    for (std::size_t k = 0; k < trajectory.tau.size(); ++k) {
      plan.t.push_back(trajectory.tau[k] * trajectory.tf);
      std::copy_n(trajectory.states[k].begin(), vehicle::kStates,
                  plan.states.emplace_back().begin());
      std::copy_n(trajectory.controls[k].begin(), vehicle::kControls,
                  plan.controls.emplace_back().begin());
    }
    return plan;
  }

  using Last = bench::Last;
  bench::PlannerCycle planner_;
  const std::uint64_t seed_;
  std::unique_ptr<nlp::Solver> solver_;
  std::optional<Last> last_;
};

/// Recorded cycles drawn by the seed, each with another predicted state.
std::vector<Cycle> perturbed(const std::vector<Cycle>& cycles, const Arguments& arguments,
                             bench::PlannerCycle& planner) {
  std::vector<Cycle> result;
  const std::uint64_t seed = arguments.seed + 1000;
  for (std::size_t i = 0; i < arguments.perturbed; ++i) {
    const double draw = 0.5 * (1 + bench::spread(seed + 1, i));
    Cycle cycle = cycles[static_cast<std::size_t>(draw * static_cast<double>(cycles.size()))];
    cycle.request.X0p = bench::moved(cycle.request.X0p, bench::kCycleSpread, seed, i);
    cycle.perturbed = true;
    cycle.solved = false;
    bench::place_starts(planner, cycle);
    result.push_back(std::move(cycle));
  }
  return result;
}

Arguments parse(int argc, char** argv) {
  Arguments a;
  CLI::App app("Records planning cycles of planner P_D in closed loop.");
  app.add_option("--environment", a.environment, "E_B, E_C, ...");
  app.add_option("--out", a.out, "file to write")->required();
  app.add_option("--cycles", a.cycles, "recorded cycles");
  app.add_option("--perturbed", a.perturbed, "perturbed cycles");
  app.add_option("--seed", a.seed, "of starts and perturbations");
  app.add_option("--backends", a.backends, "that drive")->delimiter(',');
  bench::parse_or_exit(app, argc, argv);
  return a;
}

}  // namespace

int main(int argc, char** argv) try {
  const Arguments arguments = parse(argc, argv);
  const std::vector<double> horizons = {0.5, 0.1};
  const std::size_t parts = horizons.size() * arguments.backends.size();
  std::vector<Cycle> cycles;
  int drives = 0;
  for (const double tex : horizons)
    for (const auto& backend : arguments.backends)
      Recorder(arguments, backend, tex).run((arguments.cycles + parts - 1) / parts, drives, cycles);
  if (cycles.empty()) throw InvalidValue(arguments.environment, "no cycles", "a drive");
  bench::PlannerCycle planner(bench::load(arguments.environment, horizons.front()));
  const auto more = perturbed(cycles, arguments, planner);
  cycles.insert(cycles.end(), more.begin(), more.end());
  bench::write_cycles(arguments.out, planner, arguments.environment, cycles);
  return 0;
} catch (const std::exception& error) {
  std::cerr << "bench_record: " << error.what() << "\n";
  return 1;
}
