#include <fmt/format.h>

#include <memory>

#include "commands.hpp"
#include "exit_code.hpp"
#include "interrupt.hpp"
#include "slalom/io/drive_files.hpp"
#include "slalom/io/results_folder.hpp"
#include "slalom/sim/closed_loop.hpp"

namespace slalom::app {
namespace {

const std::vector<std::string> kOutcomes = {"solved", "not_optimal", "interrupted"};

std::string plan_text(const sim::Scenario& scenario, const sim::FirstPlan& first) {
  const auto& cycle = *first.cycle;
  const auto& plan = cycle.plan;
  const auto& report = plan.report;
  auto text = fmt::format(
      "{} with {}: {} after {} iterations, {:.3f} s; from {:g} s on, {:.3f} s long, cost {:.4f}\n",
      scenario.name, scenario.planner.name, report.status_text(), report.iterations, report.wall_s,
      plan.t_start, plan.tf, report.cost);
  if (first.warm_up) {
    const auto& before = first.warm_up->plan.report;
    text += fmt::format(
        "  after a warm-up solve of the same problem: {} after {} iterations, {:.3f} s\n",
        before.status_text(), before.iterations, before.wall_s);
  }
  for (const auto& [name, value] : report.cost_terms)
    text += fmt::format("  {:<12} {:>12.4f}\n", name, value);
  text += fmt::format("{:>7} {:>9} {:>9} {:>8} {:>8} {:>8} {:>8} {:>8} {:>8} {:>8} {:>8}\n", "t",
                      "x", "y", "v", "r", "psi", "sa", "ux", "ax", "sr", "jx");
  for (std::size_t k = 0; k < plan.t.size(); ++k) {
    const auto& s = plan.states[k];
    text += fmt::format("{:>7.3f} {:>9.3f} {:>9.3f}", plan.t_start + plan.t[k], s[0], s[1]);
    for (std::size_t i = 2; i < s.size(); ++i) text += fmt::format(" {:>8.4f}", s[i]);
    for (double u : plan.controls[k]) text += fmt::format(" {:>8.4f}", u);
    text += "\n";
  }
  return text;
}

int plan(const CommonOptions& options) {
  poll_interrupts();
  check_expectations(options.expect, kOutcomes);
  const auto scenario = io::load_scenario(options.request);
  io::ResultsFolder folder;
  if (options.writes()) write_or_fail([&] { folder = {options.out, options.force}; });
  const auto first = sim::first_plan(scenario, interrupted);
  const auto& cycle = first.cycle;
  const auto* warm_up = first.warm_up ? &*first.warm_up : nullptr;
  if (!cycle || (interrupted() && !cycle->plan.report.solved))
    return exit_code_for("interrupted", options.expect);
  if (options.writes())
    write_or_fail([&] { io::write_plan(options.out, scenario, *cycle, warm_up); });
  if (options.json) {
    print(io::plan_json(scenario, *cycle, warm_up));
  } else if (!options.quiet) {
    print(plan_text(scenario, first));
  }
  return exit_code_for(cycle->plan.report.solved ? "solved" : "not_optimal", options.expect);
}

}  // namespace

void add_plan(CLI::App& app, Command& run) {
  auto options = std::make_shared<CommonOptions>();
  auto* command = app.add_subcommand("plan", "Plan once from the start, open loop");
  add_scenario(*command, *options);
  add_overrides(*command, *options, true);
  add_output(*command, *options);
  add_printing(*command, *options);
  add_expect(*command, *options, "solved, not_optimal, interrupted");
  command->footer(
      std::string("The plan starts at tex, from the state predicted there, as the first plan of a\n"
                  "drive does. Columns are SI units and radians.\n"
                  "Example: slalom plan E_B --planner P_C\n\n") +
      kExitCodeHelp);
  command->callback([options, &run] { run = [options] { return plan(*options); }; });
}

}  // namespace slalom::app
