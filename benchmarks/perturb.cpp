// Perturbs recorded cycles and solves them, by ours and by Ipopt; a line of JSON for each.
//
//   bench_perturb --environment E_C --cycles FILE [--seed 1] [--width 4] [--first 0] [--count 100]
//                 [--deadline 0.002] [--floor 0.9]
//
// Ours solves each twice, without a deadline and with one, from the shifted plan; allocations are
// counted. Ipopt solves it from the same start. What ours calls infeasible, Ipopt tries from two
// more starts: straight on, and the point where ours ended.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "command_line.hpp"
#include "cycle_file.hpp"
#include "slalom/nlp/check.hpp"
#include "support/allocation_count.hpp"

namespace {

using namespace slalom;
using bench::Cycle;
using nlohmann::json;

struct Arguments {
  std::string environment = "E_C", cycles;
  std::uint64_t seed = 1;
  double width = 4, deadline = 0.002, floor = 0.9;
  std::size_t first = 0, count = 100;
};

/// Cycle `i` of the study: a recorded one with another predicted state.
Cycle perturbed(const std::vector<Cycle>& recorded, const Arguments& a, std::size_t i,
                bench::PlannerCycle& planner) {
  const double draw = 0.5 * (1 + bench::spread(a.seed + 1, i));
  Cycle cycle = recorded[static_cast<std::size_t>(draw * static_cast<double>(recorded.size()))];
  vehicle::State width = bench::kCycleSpread;
  for (double& half : width) half *= a.width;
  cycle.request.X0p = bench::moved(cycle.request.X0p, width, a.seed, i);
  bench::place_starts(planner, cycle);
  return cycle;
}

json verdict(nlp::Problem& problem, const nlp::Answer& answer, const nlp::Options& options) {
  const auto residuals = nlp::check(problem, answer.point, options);
  return {{"status", nlp::to_string(answer.status)},
          {"confirmed", residuals.solved(options)},
          {"iterations", answer.iterations},
          {"cpu_s", answer.cpu_s},
          {"phi", residuals.phi},
          {"violation", residuals.violation}};
}

class Study {
 public:
  explicit Study(const Arguments& a)
      : arguments_(a),
        planner_(bench::load(a.environment, 0.5)),
        recorded_(bench::read_cycles(a.cycles, planner_)),
        ours_(nlp::make_solver("interior_point")),
        ipopt_(nlp::make_solver("ipopt")) {
    options_.floor = a.floor;
    std::erase_if(recorded_, [](const Cycle& cycle) { return cycle.perturbed; });
    nlp::Options none = options_;
    none.max_iterations = 0;
    for (const bool in_range : {false, true}) {  // so that the memory is there
      const Cycle* cycle = nullptr;
      for (const auto& c : recorded_)
        if (c.in_range == in_range) cycle = &c;
      if (cycle == nullptr) continue;
      place(*cycle, true);
      ours_->solve(form_->transcription, start_, none, answer_);
    }
  }

  json run(std::size_t i) {
    const Cycle cycle = perturbed(recorded_, arguments_, i, planner_);
    place(cycle, true);
    json line = {{"cycle", i}, {"warm", options_.warm_start}};
    std::size_t allocations = 0;
    line["ours"] = solve_ours(options_, allocations);
    const nlp::Answer found = answer_;
    nlp::Options limited = options_;
    limited.time_limit = arguments_.deadline;
    line["deadline"] = solve_ours(limited, allocations);
    line["deadline"]["longest_step_s"] = answer_.longest_step_s;
    line["allocations"] = allocations;
    line["ipopt"] = solve_ipopt();
    if (found.status == nlp::Status::infeasible) {
      place(cycle, false);
      line["ipopt_cold"] = solve_ipopt();
      start_.x = found.point.x;
      line["ipopt_from_ours"] = solve_ipopt();
    }
    return line;
  }

 private:
  void place(const Cycle& cycle, bool warm) {
    form_ = &planner_.form(cycle.in_range);
    form_->update(cycle.request);
    planner_.start(cycle.request, warm && cycle.last ? &*cycle.last : nullptr, start_);
    options_.warm_start = !start_.y.empty();
  }
  json solve_ours(const nlp::Options& options, std::size_t& allocations) {
    {
      AllocationCount count;
      ours_->solve(form_->transcription, start_, options, answer_);
      allocations += count.allocations();
    }
    return verdict(form_->transcription, answer_, options);
  }
  json solve_ipopt() {
    return verdict(form_->transcription, ipopt_->solve(form_->transcription, start_, options_),
                   options_);
  }

  const Arguments arguments_;
  bench::PlannerCycle planner_;
  std::vector<Cycle> recorded_;
  std::unique_ptr<nlp::Solver> ours_, ipopt_;
  nlp::Options options_;
  bench::Form* form_ = nullptr;
  nlp::Start start_;
  nlp::Answer answer_;
};

Arguments parse(int argc, char** argv) {
  Arguments a;
  CLI::App app("Perturbs recorded cycles and solves them, by ours and by Ipopt.");
  app.add_option("--environment", a.environment, "E_B, E_C, ...");
  app.add_option("--cycles", a.cycles, "of bench_record")->required();
  app.add_option("--seed", a.seed, "of draws and perturbations");
  app.add_option("--width", a.width, "of the perturbations, in units of those of bench_record");
  app.add_option("--first", a.first, "cycle to begin with");
  app.add_option("--count", a.count, "cycles to solve");
  app.add_option("--deadline", a.deadline, "of the second solve by ours [s]");
  app.add_option("--floor", a.floor, "barrier floor");
  bench::parse_or_exit(app, argc, argv);
  return a;
}

}  // namespace

int main(int argc, char** argv) try {
  const Arguments a = parse(argc, argv);
  Study study(a);
  for (std::size_t i = a.first; i < a.first + a.count; ++i) std::cout << study.run(i) << std::endl;
  return 0;
} catch (const std::exception& error) {
  std::cerr << "bench_perturb: " << error.what() << "\n";
  return 1;
}
