// Times the functions of the planner's problem at a recorded cycle: from straight on, and at its
// shifted plan. Prints JSON; run.py makes the table.
//
//   bench_functions --environment E_C --cycles FILE [--cycle 4] [--repeats 200]

#include <CLI/CLI.hpp>
#include <chrono>
#include <iostream>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "command_line.hpp"
#include "cycle_file.hpp"
#include "slalom/base/kernels.hpp"
#include "slalom/ocp/transcription.hpp"

namespace {

using namespace slalom;
using nlohmann::json;

struct Arguments {
  std::string environment = "E_C", cycles;
  std::size_t cycle = 4;
  int repeats = 200;
};

Arguments parse(int argc, char** argv) {
  Arguments a;
  CLI::App app("Times the functions of the planner's problem.");
  app.add_option("--environment", a.environment, "E_B, E_C, ...");
  app.add_option("--cycles", a.cycles, "of bench_record")->required();
  app.add_option("--cycle", a.cycle, "which of them");
  app.add_option("--repeats", a.repeats, "calls of each function");
  bench::parse_or_exit(app, argc, argv);
  return a;
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

json time_all(const Arguments& arguments) {
  bench::PlannerCycle planner(bench::load(arguments.environment, 0.5));
  const auto cycles = bench::read_cycles(arguments.cycles, planner);
  const bench::Cycle& cycle = cycles.at(arguments.cycle);
  bench::Form& form = planner.form(cycle.in_range);
  form.update(cycle.request);
  auto& transcription = form.transcription;
  const auto& scale = transcription.structure().variable_scale;
  const auto time_at = [&](std::vector<double> x) {
    for (std::size_t i = 0; i < x.size(); ++i) x[i] /= scale[i];
    json result = {{"functions_us", time_functions(transcription, x, arguments.repeats)}};
    return result;
  };
  return {{"guess", time_at(cycle.cold_x)}, {"plan", time_at(cycle.warm_x)}};
}

}  // namespace

int main(int argc, char** argv) try {
  std::cout << time_all(parse(argc, argv)).dump() << "\n";
  return 0;
} catch (const std::exception& error) {
  std::cerr << "bench_functions: " << error.what() << "\n";
  return 1;
}
