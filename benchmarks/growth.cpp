// Time of an iteration against the number of intervals, of phases, and of collocation points in an
// interval, on a problem that has all a structured solver may stumble over; and time and memory of
// whole solves against the numbers of controls and of states; JSON.
//
//   bench_growth [--N 10,20,40,80] [--phases 1,2,4,8] [--scheme hermite_simpson] [--points 3,5,10]
//                [--solves 5] [--iterations 25]
//   bench_growth --controls 400 | --states 200
//
// Each phase is a chain of four oscillators driven by two forces, with a free final time, static
// parameters that all phases share by links, an integral constraint, and, from the last phase to
// the first, a periodic link of the states.

#include <sys/resource.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdlib>
#include <iostream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "slalom/base/timer.hpp"
#include "slalom/nlp/solver.hpp"
#include "slalom/ocp/phases.hpp"
#include "slalom/ocp/solve.hpp"

namespace {

using namespace slalom;
using ocp::Bounds;
using ocp::Expr;

constexpr std::size_t kParameters = 15, kMasses = 4;

ocp::Problem phase(std::size_t number) {
  ocp::Problem p("phase " + std::to_string(number));
  std::vector<Expr> x, v, k;
  for (std::size_t i = 0; i < kMasses; ++i) {
    x.push_back(p.state("x" + std::to_string(i), {-3, 3}));
    v.push_back(p.state("v" + std::to_string(i), {-5, 5}));
  }
  const Expr a = p.control("a", {-1, 1}), b = p.control("b", {-1, 1});
  for (std::size_t i = 0; i < kParameters; ++i)
    k.push_back(p.static_parameter("k" + std::to_string(i), {0.5, 1.5}, 1));
  for (std::size_t i = 0; i < kMasses; ++i) {
    const Expr left = i == 0 ? x[i] : x[i] - x[i - 1];
    Expr force = i == 0 ? a : i + 1 == kMasses ? b : Expr(0);
    force = force - k[3 * i] * sin(left) - 0.1 * k[3 * i + 1] * v[i] * square(v[i]);
    if (i + 1 < kMasses) force = force + k[3 * i + 2] * sin(x[i + 1] - x[i]);
    p.dynamics(x[i], v[i]);
    p.dynamics(v[i], force);
  }
  const double begin = static_cast<double>(number);
  p.initial_time(number == 0 ? Bounds::equal(0) : Bounds{begin - 0.4, begin + 0.4}, begin);
  p.final_time({begin + 0.6, begin + 1.4}, begin + 1);
  Expr effort = square(a) + square(b), away = Expr(0), tuning = Expr(0);
  for (const auto& each : x) away = away + square(each - 0.3);
  for (const auto& each : k) tuning = tuning + square(each - 1);
  p.lagrange("cost", effort + away + exp(-v[0]));
  p.mayer("tuning", tuning);
  p.integral("work", a * v[0] + b * v[kMasses - 1], {-2, 2});
  return p;
}

ocp::PhasedProblem problem(std::size_t phases) {
  ocp::PhasedProblem all("oscillators");
  for (std::size_t p = 0; p < phases; ++p) all.add(phase(p));
  for (std::size_t p = 1; p < phases; ++p) {
    all.connect(p - 1, p);
    for (std::size_t i = 0; i < kParameters; ++i)
      all.link("k" + std::to_string(i) + " of phase " + std::to_string(p),
               all.phases()[p - 1].static_parameters()[i].symbol -
                   all.phases()[p].static_parameters()[i].symbol);
  }
  for (std::size_t i = 0; i < 2 * kMasses; ++i) {
    const auto &first = all.phases().front().states()[i], &last = all.phases().back().states()[i];
    all.link("periodic " + first.name, last.final_symbol - first.initial_symbol);
  }
  return all;
}

struct Solves {
  int count = 5;
  int iterations = 25;  ///< of one at the most
};

/// A mass pushed one way by half of many forces and the other way by the rest.
ocp::Problem many_controls(std::size_t count) {
  ocp::Problem p("controls");
  const Expr x = p.state("x"), v = p.state("v");
  Expr force = 0, effort = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const Expr u = p.control("u" + std::to_string(i), {0, 1});
    force = i < count / 2 ? force + u : force - u;
    effort = effort + square(u);
  }
  const double half = static_cast<double>(count) / 2;
  p.dynamics(x, v);
  p.dynamics(v, force / half * 20);
  p.lagrange("effort", effort / half);
  p.fix(x, 0, 1);
  p.fix(v, 0, 0);
  return p;
}

/// A rod in so many pieces, heated at one end until all of it is warm.
ocp::Problem many_states(std::size_t count) {
  ocp::Problem p("states");
  std::vector<Expr> x;
  for (std::size_t i = 0; i < count; ++i) x.push_back(p.state("x" + std::to_string(i), {-1, 4}));
  const Expr u = p.control("u", {0, 3});
  const double pieces = static_cast<double>(count);
  Expr cold = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const Expr &left = i == 0 ? u : x[i - 1], &right = i + 1 == count ? x[i] : x[i + 1];
    p.dynamics(x[i], pieces * pieces * (left - 2 * x[i] + right));
    p.initial_bounds(x[i], Bounds::equal(0));
    cold = cold + square(x[i] - 1);
  }
  p.lagrange("cost", 0.1 * square(u) + cold / pieces);
  return p;
}

/// Most memory that this process has had [MiB].
double peak_mib() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024;
}

/// Thread time of one solve, set-up, solver and check, on 40 intervals, and all memory until then.
nlohmann::json measure_whole(const char* what, std::size_t size, const ocp::Problem& problem) {
  const Timer timer;
  const ocp::Solution solution = ocp::solve(problem);
  const double whole = timer.cpu();
  return {{what, size},
          {"status", nlp::to_string(solution.status)},
          {"objective", solution.objective},
          {"iterations", solution.iterations},
          {"backend", solution.backend},
          {"iteration_s", whole / std::max(1, solution.iterations)},
          {"whole_s", whole},
          {"peak_mib", peak_mib()}};
}

/// Least thread time of an iteration of these solves.
nlohmann::json measure(std::size_t phases, int N, const ocp::Scheme& scheme, const Solves& solves) {
  ocp::PhasedTranscription transcription(
      problem(phases), {phases, ocp::PhasedTranscription::Grid{ocp::Mesh::uniform(N), scheme}});
  nlp::Start start;
  for (std::size_t p = 0; p < phases; ++p) {
    const auto& part = transcription.phase(p);
    const auto x = part.point(part.straight_guess());
    start.x.insert(start.x.end(), x.begin(), x.end());
  }
  nlp::Options options;
  options.max_iterations = solves.iterations;
  options.floor = 1e-2;
  const auto solver = nlp::make_solver("interior_point");
  nlp::Answer answer;
  double least = 1e9;
  for (int repeat = 0; repeat < solves.count; ++repeat) {
    solver->solve(transcription, start, options, answer);
    least = std::min(least, answer.cpu_s / std::max(1, answer.iterations));
  }
  const auto& shape = transcription.structure();
  return {{"phases", phases},
          {"N", N},
          {"scheme", scheme.name},
          {"points", scheme.points.size() - 1},
          {"stages", shape.stages},
          {"variables", shape.variables},
          {"rows", shape.rows},
          {"iterations", answer.iterations},
          {"status", nlp::to_string(answer.status)},
          {"backend", answer.backend},
          {"iteration_s", least}};
}

}  // namespace

int main(int argc, char** argv) try {
  std::vector<int> N = {10, 20, 40, 80};
  std::vector<std::size_t> phases = {1, 2, 4, 8};
  std::size_t controls = 0, states = 0;
  std::vector<int> points = {};
  std::string scheme = "hermite_simpson";
  Solves solves;
  CLI::App app("Times an iteration against intervals and phases.");
  app.add_option("--N", N, "numbers of intervals of each of four phases")->delimiter(',');
  app.add_option("--phases", phases, "numbers of phases of 20 intervals")->delimiter(',');
  app.add_option("--scheme", scheme, "collocation scheme");
  app.add_option("--points", points, "LGR points in each of four intervals of one phase")
      ->delimiter(',');
  app.add_option("--solves", solves.count, "of each problem");
  app.add_option("--iterations", solves.iterations, "of a solve at the most");
  auto* const option = app.add_option("--controls", controls,
                                      "of a whole solve, and nothing else: its peak of memory");
  app.add_option("--states", states, "likewise")->excludes(option);
  CLI11_PARSE(app, argc, argv);
  nlohmann::json all = nlohmann::json::array();
  if (controls > 0) all.push_back(measure_whole("controls", controls, many_controls(controls)));
  if (states > 0) all.push_back(measure_whole("states", states, many_states(states)));
  if (controls + states > 0) {
    std::cout << all.dump() << "\n";
    return 0;
  }
  for (const int n : N) all.push_back(measure(4, n, ocp::scheme(scheme), solves));
  for (const std::size_t p : phases) all.push_back(measure(p, 20, ocp::scheme(scheme), solves));
  for (const int n : points) all.push_back(measure(1, 4, ocp::lgr(n), solves));
  std::cout << all.dump() << "\n";
  return 0;
} catch (const std::exception& error) {
  std::cerr << "bench_growth: " << error.what() << "\n";
  return 1;
}
