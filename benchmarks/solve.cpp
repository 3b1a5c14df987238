// Solves recorded cycles and times them; JSON on standard output, run.py makes the tables.
//
//   bench_solve --cycles FILE --environment E_C --backend NAME --floor MU --tol TOL --start
//   warm|cold
//               [--first I] [--count N] [--kernels baseline|avx2|avx512]
//   bench_solve --growth --environment E_C --cycles FILE --backend NAME --floor MU
//               [--N 15,30,...] [--obstacles 0,38,...]
//
// A cycle's time is what the planner spends: update of the problem, shift, solve and check, once.

#include <CLI/CLI.hpp>
#include <chrono>
#include <iostream>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "command_line.hpp"
#include "cycle_file.hpp"
#include "slalom/base/error.hpp"
#include "slalom/base/kernels.hpp"
#include "slalom/base/timer.hpp"
#include "slalom/nlp/check.hpp"

namespace {

using namespace slalom;
using bench::Cycle;
using nlohmann::json;

struct Arguments {
  std::string environment = "E_C", cycles, backend, start = "warm", kernels;
  double floor = 0, tol = 1e-6, dual_tol = 1e-3, constraint_tol = 1e-6;
  std::size_t first = 0, count = static_cast<std::size_t>(-1);
  bool growth = false, log = false;
  std::vector<int> N;
  std::vector<std::size_t> obstacles;
};

nlp::Options options_of(const Arguments& a) {
  nlp::Options options;
  options.floor = a.floor;
  options.tol = a.tol;
  options.dual_tol = a.dual_tol;
  options.constraint_tol = a.constraint_tol;
  options.print_level = a.log ? 1 : 0;
  return options;
}

/// One cycle as the planner does it, timed from request to checked answer.
json timed_solve(bench::PlannerCycle& planner, nlp::Solver& solver, const Cycle& cycle,
                 const bench::Last* last, nlp::Options options, nlp::Start& start,
                 nlp::Answer& answer) {
  bench::Form& form = planner.form(cycle.in_range);
  const Timer timer;
  form.update(cycle.request);
  planner.start(cycle.request, last, start);
  options.warm_start = !start.y.empty();
  solver.solve(form.transcription, start, options, answer);
  const auto residuals = nlp::check(form.transcription, answer.point, options);
  const double wall_s = timer.wall(), cpu_s = timer.cpu();

  json result = bench::describe(residuals, form.transcription.trajectory(answer.point.x));
  result["wall_s"] = wall_s;
  result["cpu_s"] = cpu_s;
  result["solver_cpu_s"] = answer.cpu_s;
  result["claimed"] = answer.status == nlp::Status::solved;
  result["status"] = nlp::to_string(answer.status);
  result["backend"] = answer.backend;
  result["iterations"] = answer.iterations;
  return result;
}

/// One solve without an iteration, as the planner prepares a form.
void prepare(bench::PlannerCycle& planner, nlp::Solver& solver, bool in_range, nlp::Start& start,
             nlp::Answer& answer) {
  const auto& goal = planner.scenario().goal;
  planner::Request request;
  request.X0p = planner.scenario().start;
  request.X0p[vehicle::X] = goal.x;
  request.X0p[vehicle::Y] = goal.y - (in_range ? 0.5 : 1.5) * planner.scenario().planner.L_range;
  planner.form(in_range).update(request);
  planner.start(request, nullptr, start);
  nlp::Options options;
  options.max_iterations = 0;
  solver.solve(planner.form(in_range).transcription, start, options, answer);
}

/// setup_s: from reading the scenario until a problem can be solved.
json solve_recorded(const Arguments& a) {
  nlp::Start start;
  nlp::Answer answer;
  const Timer timer;
  bench::PlannerCycle planner(bench::load(a.environment, 0.5));
  const auto solver = nlp::make_solver(a.backend);
  for (const bool in_range : {true, false}) prepare(planner, *solver, in_range, start, answer);
  const double setup_s = timer.cpu();

  const auto cycles = bench::read_cycles(a.cycles, planner);
  const bool warm = a.start == "warm";
  json solves = json::array();
  for (std::size_t i = a.first; i < std::min(cycles.size(), a.first + a.count); ++i) {
    const bench::Last* last = warm && cycles[i].last ? &*cycles[i].last : nullptr;
    solves.push_back(timed_solve(planner, *solver, cycles[i], last, options_of(a), start, answer));
    solves.back()["cycle"] = i;
  }
  const auto& shape = planner.form(false).transcription.structure();
  return {{"setup_s", setup_s},
          {"variables", shape.variables},
          {"rows", shape.rows},
          {"jacobian_entries", shape.jacobian_col.size()},
          {"hessian_entries", shape.hessian_row.size()},
          {"cycles", std::move(solves)}};
}

/// The first cycles of the first recorded drive on another mesh or with other obstacles, each
/// from the last one's own plan.
json solve_chain(const Arguments& a, const std::vector<Cycle>& cycles, std::optional<int> N,
                 std::optional<std::size_t> obstacles) {
  constexpr std::size_t kChain = 12;
  const Timer timer;
  bench::PlannerCycle planner(bench::load(a.environment, 0.5, N, obstacles));
  const auto solver = nlp::make_solver(a.backend);
  nlp::Start start;
  nlp::Answer answer;
  prepare(planner, *solver, false, start, answer);
  json result = {{"N", planner.scenario().planner.N},
                 {"obstacles", planner.scenario().obstacles.size()},
                 {"rows", planner.form(false).transcription.structure().rows},
                 {"setup_s", timer.cpu()}};
  json solves = json::array();
  std::optional<bench::Last> last;
  for (std::size_t i = 0; i < cycles.size() && cycles[i].drive == 0 && i < kChain; ++i) {
    const auto& request = cycles[i].request;
    if (cycles[i].in_range) break;
    if (i > 0 && request.t0 > cycles[i - 1].request.t0 + 1.5 * (request.t_start - request.t0))
      break;  // thinned out
    solves.push_back(timed_solve(planner, *solver, cycles[i], last ? &*last : nullptr,
                                 options_of(a), start, answer));
    if (answer.status != nlp::Status::solved) continue;
    auto plan = planner.form(false).transcription.trajectory(answer.point.x);
    last = bench::Last{{request.t_start, request.X0p, std::move(plan), false}, answer.point};
  }
  result["cycles"] = std::move(solves);
  return result;
}

json growth(const Arguments& a) {
  bench::PlannerCycle recorded(bench::load(a.environment, 0.5));
  const auto cycles = bench::read_cycles(a.cycles, recorded);
  json result = json::array();
  for (const int N : a.N) result.push_back(solve_chain(a, cycles, N, {}));
  for (const std::size_t obstacles : a.obstacles)
    result.push_back(solve_chain(a, cycles, {}, obstacles));
  return {{"growth", result}};
}

Arguments parse(int argc, char** argv) {
  Arguments a;
  CLI::App app("Solves recorded cycles and times them.");
  app.add_option("--environment", a.environment, "E_B, E_C, ...");
  app.add_option("--cycles", a.cycles, "of bench_record")->required();
  app.add_option("--backend", a.backend, "ipopt or interior_point")->required();
  app.add_option("--start", a.start, "warm or cold")->check(CLI::IsMember({"warm", "cold"}));
  app.add_option("--kernels", a.kernels, "baseline, avx2 or avx512; the best by default");
  app.add_option("--floor", a.floor, "barrier floor; 0 for none");
  app.add_option("--tol", a.tol, "optimality tolerance without a floor");
  app.add_option("--dual-tol", a.dual_tol, "largest gradient of the Lagrangian");
  app.add_option("--constraint-tol", a.constraint_tol, "largest violation");
  app.add_option("--first", a.first, "cycle to begin with");
  app.add_option("--count", a.count, "cycles to solve");
  app.add_flag("--log", a.log, "prints the iterations before the JSON");
  app.add_flag("--growth", a.growth, "other meshes and numbers of obstacles");
  app.add_option("--N", a.N, "numbers of intervals")->delimiter(',');
  app.add_option("--obstacles", a.obstacles, "numbers of obstacles")->delimiter(',');
  bench::parse_or_exit(app, argc, argv);
  return a;
}

}  // namespace

int main(int argc, char** argv) try {
  const Arguments a = parse(argc, argv);
  if (!a.kernels.empty()) select_kernels(kernel_set(a.kernels));
  json result = a.growth ? growth(a) : solve_recorded(a);
  result["kernels"] = to_string(current_kernels());
  std::cout << result.dump() << "\n";
  return 0;
} catch (const std::exception& error) {
  std::cerr << "bench_solve: " << error.what() << "\n";
  return 1;
}
