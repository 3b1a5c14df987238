// Times the planner's first OCP in E_C (P_D, N 15, 38 obstacles) and its solves over recorded
// cycles. Prints JSON; run.py makes the tables.
//
//   bench_planner --cycles FILE [--backend NAME] [--repeats N] [--profile]
//
// --repeats 0 leaves the functions out.

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "builder.hpp"
#include "slalom/base/kernels.hpp"
#include "slalom/nlp/check.hpp"
#include "slalom/nlp/solver.hpp"
#include "slalom/ocp/scheme.hpp"
#include "slalom/ocp/transcription.hpp"
#include "trajectory_problem.hpp"

namespace {

using namespace slalom;
using nlohmann::json;
using vehicle::kControls;
using vehicle::kStates;

struct Arguments {
  std::string cycles, backend;
  int repeats = 200;
  bool profile = false;
};

Arguments parse(int argc, char** argv) {
  Arguments result;
  for (int i = 1; i < argc; ++i) {
    const std::string_view name = argv[i];
    if (name == "--profile") {
      result.profile = true;
    } else if (i + 1 < argc && name == "--cycles") {
      result.cycles = argv[++i];
    } else if (i + 1 < argc && name == "--repeats") {
      result.repeats = std::atoi(argv[++i]);
    } else if (i + 1 < argc && name == "--backend") {
      result.backend = argv[++i];
    } else {
      throw std::runtime_error(
          "usage: bench_planner --cycles FILE [--backend NAME] [--repeats N] "
          "[--profile]; found " +
          std::string(name));
    }
  }
  return result;
}

/// Microseconds each of `repeats` calls took, after a few that are not counted.
template <class F>
std::vector<double> times_us(int repeats, F call) {
  using Clock = std::chrono::steady_clock;
  for (int i = 0; i < 10; ++i) call();
  std::vector<double> times;
  for (int i = 0; i < repeats; ++i) {
    const auto began = Clock::now();
    call();
    times.push_back(std::chrono::duration<double, std::micro>(Clock::now() - began).count());
  }
  return times;
}

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + values.size() / 2, values.end());
  return values[values.size() / 2];
}

// --- the environment E_C with planner P_D (section 4 of the formulation) -------------------------

planner::Settings settings() {
  planner::Settings s;
  s.N = 15;
  s.L_range = 90;
  s.kappa = 10;
  return s;
}

std::vector<planner::Obstacle> obstacles() {
  std::vector<planner::Obstacle> list = {{"O1", 6, 281, 6, 6, 0, 0}, {"O2", 18, 650, 6, 6, 0, -10}};
  for (int k = 0; k < 36; ++k)
    list.push_back({"cone " + std::to_string(k), 12, 5.0 * k, 0.38735, 0.38735, 0, 0});
  return list;
}

planner::TrajectoryProblem make_problem() {
  return {settings(),
          vehicle::Parameters{},
          {.x = 18, .y = 700, .sigma = 25},
          {.x_min = 0, .x_max = 24},
          obstacles(),
          false};
}

planner::Request request_of(const json& cycle) {
  planner::Request request;
  request.t0 = cycle.at("t0");
  request.tex = cycle.at("tex");
  request.X0p = cycle.at("X0p").get<vehicle::State>();
  return request;
}

// --- guesses (section 3, "Guess") ----------------------------------------------------------------

/// X(0) within half its tolerance of X0p, slacks 2 mu / weight inside their rows.
void place_slacks(const planner::Request& request, ocp::Trajectory& guess) {
  const planner::Settings s = settings();
  guess.slacks.clear();
  for (std::size_t i = 0; i < kStates; ++i) {
    const double tol = s.X0_tol[i];
    double& start = guess.states.front()[i];
    start = std::clamp(start, request.X0p[i] - tol / 2, request.X0p[i] + tol / 2);
    const double gap = std::fabs(start - request.X0p[i]);
    guess.slacks.push_back(gap + std::min(2 * s.floor / (s.w_ic * s.w_s0[i]), (tol - gap) / 2));
  }
}

ocp::Trajectory straight_on(const planner::Request& request) {
  const planner::Settings s = settings();
  const vehicle::State& X0p = request.X0p;
  const double tf =
      std::clamp(s.L_range / std::max(X0p[vehicle::UX], 5.0), 1.01 * s.tf_min, 0.99 * s.tf_max);
  vehicle::State end{};
  end[vehicle::X] = X0p[vehicle::X] + tf * X0p[vehicle::UX] * std::cos(X0p[vehicle::PSI]);
  end[vehicle::Y] = X0p[vehicle::Y] + tf * X0p[vehicle::UX] * std::sin(X0p[vehicle::PSI]);
  end[vehicle::PSI] = X0p[vehicle::PSI];
  end[vehicle::UX] = X0p[vehicle::UX];
  // The page's guess holds X0p at node 0 whole and the straight line from node 1 on.
  ocp::Trajectory guess{0, tf, {}, {}, {}, {}, {}};
  const auto N = static_cast<std::size_t>(s.N);
  for (std::size_t k = 0; k <= N; ++k) {
    const double tau = static_cast<double>(k) / static_cast<double>(N);
    guess.tau.push_back(tau);
    guess.states.emplace_back(end.begin(), end.end());
    for (std::size_t i : {vehicle::X, vehicle::Y})
      guess.states.back()[i] = X0p[i] + tau * (end[i] - X0p[i]);
    guess.controls.emplace_back(kControls, 0.0);
  }
  guess.states.front().assign(X0p.begin(), X0p.end());
  place_slacks(request, guess);
  return guess;
}

/// `plan` from `shift` on, linear between its nodes, its last point held, its end time kept.
ocp::Trajectory shifted(const ocp::Trajectory& plan, double shift,
                        const planner::Request& request) {
  const planner::Settings s = settings();
  ocp::Trajectory guess{0, std::clamp(plan.tf - shift, 0.2, 0.99 * s.tf_max), {}, {}, {}, {}, {}};
  for (const double tau : plan.tau) {
    const double t = std::min((shift + tau * guess.tf) / plan.tf, 1.0);
    const auto above = std::upper_bound(plan.tau.begin(), plan.tau.end(), t) - plan.tau.begin();
    const auto k = std::min(static_cast<std::size_t>(above), plan.tau.size() - 1);
    const double share = (t - plan.tau[k - 1]) / (plan.tau[k] - plan.tau[k - 1]);
    const auto mix = [&](const auto& rows) {
      std::vector<double> row(rows[k]);
      for (std::size_t i = 0; i < row.size(); ++i)
        row[i] = rows[k - 1][i] + share * (rows[k][i] - rows[k - 1][i]);
      return row;
    };
    guess.tau.push_back(tau);
    guess.states.push_back(mix(plan.states));
    guess.controls.push_back(mix(plan.controls));
  }
  place_slacks(request, guess);
  return guess;
}

/// A recorded plan: its end time and, node by node, state and control.
ocp::Trajectory plan_of(const json& recorded, const planner::Request& request) {
  ocp::Trajectory plan{0, recorded.at("tf"), {}, {}, {}, {}, {}};
  const json& nodes = recorded.at("nodes");
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    const auto node = nodes[k].get<std::vector<double>>();
    plan.tau.push_back(static_cast<double>(k) / static_cast<double>(nodes.size() - 1));
    plan.states.emplace_back(node.begin(), node.begin() + kStates);
    plan.controls.emplace_back(node.begin() + kStates, node.end());
  }
  place_slacks(request, plan);
  return plan;
}

json to_json(const ocp::Trajectory& trajectory) {
  json nodes = json::array();
  for (std::size_t k = 0; k < trajectory.tau.size(); ++k) {
    json node = trajectory.states[k];
    for (double u : trajectory.controls[k]) node.push_back(u);
    nodes.push_back(std::move(node));
  }
  return {{"tf", trajectory.tf}, {"nodes", nodes}, {"slacks", trajectory.slacks}};
}

// --- evaluations ---------------------------------------------------------------------------------

std::vector<KernelSet> kernel_sets() {
  std::vector<KernelSet> sets{KernelSet::baseline};
  if (best_kernels() != KernelSet::baseline) sets.push_back(best_kernels());
  return sets;
}

/// By kernel set.
json time_functions(ocp::Transcription& transcription, const std::vector<double>& x, int repeats) {
  const std::vector<double> y(transcription.structure().rows, 1.0);
  nlp::Evaluation at;
  json result;
  for (const auto set : kernel_sets()) {
    select_kernels(set);
    const auto time = [&](nlp::Parts parts) {
      return times_us(repeats, [&] {
        if (transcription.evaluate(x, 1, y, parts, at)) throw std::runtime_error("not finite");
      });
    };
    result[to_string(set)] = {
        {"all_first", time({.values = true, .derivatives = true})},
        {"all_second", time({.values = true, .derivatives = true, .hessian = true})},
        {"hessian", time({.hessian = true})}};
  }
  return result;
}

/// Where one evaluation's time goes, batch by batch.
json profile(const ocp::Problem& problem, const std::vector<double>& x, int repeats) {
  auto data = ocp::transcribe(problem, ocp::Mesh::uniform(settings().N), ocp::trapezoidal());
  const std::vector<double> y(data.structure.rows, 1.0);
  std::vector<double> rows(data.structure.rows), terms(data.terms.size());
  std::vector<double> gradient(data.structure.variables),
      jacobian(data.structure.jacobian_row.size());
  std::vector<double> hessian(data.structure.hessian_row.size());
  json result;
  for (const auto set : kernel_sets()) {
    select_kernels(set);
    json batches = json::array();
    for (auto& batch : data.batches) {
      const auto us = [&](auto call) { return median(times_us(repeats, call)); };
      const nlp::Parts values{.values = true}, first{.values = true, .derivatives = true},
          second{.hessian = true}, all{.values = true, .derivatives = true, .hessian = true};
      const auto count = [&](nlp::Parts p) {
        return batch.function.instructions({p.values, p.derivatives, p.hessian});
      };
      batch.load(x);
      batch.set_weights(1, y);
      batches.push_back({{"first_output", batch.outputs.front()},
                         {"outputs", batch.outputs.size()},
                         {"lanes", batch.lanes},
                         {"variables", batch.function.variables()},
                         {"data", batch.function.data()},
                         {"instructions",
                          {{"values", count(values)},
                           {"first", count(first)},
                           {"hessian", count(second)},
                           {"all", count(all)}}},
                         {"runs",
                          {{"rows", batch.to_rows.runs()},
                           {"jacobian", batch.to_jacobian.runs()},
                           {"gradient", batch.to_gradient.runs()},
                           {"hessian", batch.to_hessian.runs()}}},
                         {"us",
                          {{"load", us([&] { batch.load(x); })},
                           {"weights", us([&] { batch.set_weights(1, y); })},
                           {"run_values", us([&] { batch.run(values); })},
                           {"run_first", us([&] { batch.run(first); })},
                           {"run_hessian", us([&] { batch.run(second); })},
                           {"run_all", us([&] { batch.run(all); })},
                           {"scatter_values", us([&] {
                              batch.to_rows.scatter(batch.evaluator->values(), rows);
                              batch.to_terms.scatter(batch.evaluator->values(), terms);
                            })},
                           {"scatter_first", us([&] {
                              batch.to_jacobian.scatter(batch.evaluator->jacobian(), jacobian);
                              batch.to_gradient.scatter(batch.evaluator->jacobian(), gradient);
                            })},
                           {"scatter_hessian", us([&] {
                              batch.to_hessian.scatter(batch.evaluator->hessian(), hessian);
                            })}}}});
    }
    result[to_string(set)] = std::move(batches);
  }
  return result;
}

/// A problem that keeps the time spent in its functions.
class Timed final : public nlp::Problem {
 public:
  explicit Timed(nlp::Problem& problem) : problem_(problem) {}

  double seconds = 0;

  const nlp::Structure& structure() const override { return problem_.structure(); }
  const nlp::Limits& limits() const override { return problem_.limits(); }
  nlp::Fault evaluate(std::span<const double> x, double sigma, std::span<const double> y,
                      nlp::Parts parts, nlp::Evaluation& out) override {
    const auto began = std::chrono::steady_clock::now();
    auto fault = problem_.evaluate(x, sigma, y, parts, out);
    const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - began;
    seconds += spent.count();
    return fault;
  }
  std::string variable_name(std::size_t i) const override { return problem_.variable_name(i); }
  std::string row_name(std::size_t i) const override { return problem_.row_name(i); }

 private:
  nlp::Problem& problem_;
};

// --- solves --------------------------------------------------------------------------------------

/// One cycle's answer: times, residuals judged by the checker, and the plan.
json report(ocp::Transcription& transcription, const nlp::Answer& answer,
            const nlp::Options& options, const ocp::Trajectory& guess) {
  const auto residuals = nlp::check(transcription, answer.point, options);
  json entry = to_json(transcription.trajectory(answer.point.x));
  entry["start"] = to_json(guess);
  entry["solved"] = answer.status == nlp::Status::solved;
  entry["confirmed"] = residuals.solved(options);
  entry["status"] = nlp::to_string(answer.status);
  entry["iterations"] = answer.iterations;
  entry["f"] = residuals.objective;
  entry["phi"] = residuals.phi;
  entry["wall_s"] = answer.wall_s;
  return entry;
}

/// The first cycle once as the process's very first solve, which also makes code and memory ready;
/// then each cycle from the last solved plan, the first one from straight on again.
json time_solves(planner::TrajectoryProblem& problem, ocp::Transcription& transcription,
                 const json& cycles, const std::string& backend) {
  const auto solver = nlp::make_solver(backend);
  nlp::Options options;
  options.floor = settings().floor;
  const auto solve = [&](const nlp::Start& start, const ocp::Trajectory& guess,
                         nlp::Answer& answer) {
    Timed timed(transcription);
    answer = solver->solve(timed, start, options);
    json entry = report(transcription, answer, options, guess);
    entry["functions_s"] = timed.seconds;
    return entry;
  };
  nlp::Answer answer;
  const ocp::Trajectory first = straight_on(request_of(cycles.at(0)));
  const nlp::Start first_start{transcription.point(first), {}, {}, {}};
  json result = json::array({solve(first_start, first, answer)});
  ocp::Trajectory plan;
  double planned_at = 0;
  nlp::Start last;
  for (const auto& cycle : cycles) {
    const auto request = request_of(cycle);
    problem.update(request);
    transcription.update(problem.problem());
    options.warm_start = !plan.tau.empty();
    const auto guess = options.warm_start ? shifted(plan, request.t0 - planned_at, request) : first;
    nlp::Start start = last;
    start.x = transcription.point(guess);
    result.push_back(solve(start, guess, answer));
    if (answer.status == nlp::Status::solved) {
      plan = transcription.trajectory(answer.point.x);
      planned_at = request.t0;
      last = std::move(answer.point);
    }
  }
  return result;
}

json bench(const Arguments& arguments) {
  std::ifstream file(arguments.cycles);
  if (!file) throw std::runtime_error("cannot read '" + arguments.cycles + "' (--cycles FILE)");
  const json recording = json::parse(file);
  const auto request = request_of(recording.at("cycles").at(0));
  const auto began = std::chrono::steady_clock::now();
  planner::TrajectoryProblem problem = make_problem();
  problem.update(request);
  ocp::Transcription transcription(problem.problem(), ocp::Mesh::uniform(settings().N),
                                   ocp::trapezoidal());
  const std::vector<double> x = transcription.point(straight_on(request));
  const std::vector<double> y(transcription.structure().rows, 1.0);
  nlp::Evaluation at;
  if (transcription.evaluate(x, 1, y, {.values = true, .derivatives = true, .hessian = true}, at))
    throw std::runtime_error("not finite at the guess");
  const std::chrono::duration<double> ready = std::chrono::steady_clock::now() - began;

  const auto& shape = transcription.structure();
  json result = {{"setup_s", ready.count()},
                 {"backends", nlp::backends()},
                 {"backend", arguments.backend},
                 {"kernels", to_string(best_kernels())},
                 {"variables", shape.variables},
                 {"rows", shape.rows},
                 {"jacobian_entries", shape.jacobian_col.size()},
                 {"hessian_entries", shape.hessian_row.size()}};
  const std::vector<double> plan = transcription.point(plan_of(recording.at("point"), request));
  if (arguments.repeats > 0)
    result["functions_us"] = {{"guess", time_functions(transcription, x, arguments.repeats)},
                              {"plan", time_functions(transcription, plan, arguments.repeats)}};
  if (arguments.profile) result["profile"] = profile(problem.problem(), plan, arguments.repeats);
  if (!arguments.backend.empty())
    result["solves"] =
        time_solves(problem, transcription, recording.at("cycles"), arguments.backend);
  return result;
}

}  // namespace

int main(int argc, char** argv) try {
  std::cout << bench(parse(argc, argv)).dump() << "\n";
  return 0;
} catch (const std::exception& error) {
  std::cerr << "bench_planner: " << error.what() << "\n";
  return 1;
}
