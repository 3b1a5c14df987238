// The fastest lap of a scenario's road on one mesh, solved by ours, with all that another solver
// needs to solve the same: numbers of road, vehicle, mesh and start. JSON into a file.
//
//   bench_lap SCENARIO OUT.json --intervals N

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "lap_problem.hpp"
#include "slalom/base/error.hpp"
#include "slalom/base/timer.hpp"
#include "slalom/io/scenario_file.hpp"
#include "slalom/ocp/transcription.hpp"

namespace {

using namespace slalom;
using nlohmann::json;

json numbers_of(const vehicle::Parameters& vehicle) {
  json out;
  for (const auto& entry : vehicle::parameter_options().entries())
    std::visit([&](const auto& value) { out[entry.info.name] = value; }, entry.get(vehicle));
  return out;
}

json points_of(const ocp::Trajectory& trajectory) {
  json out = json::array();
  for (std::size_t k = 0; k < trajectory.tau.size(); ++k) {
    auto point = trajectory.states[k];
    point.insert(point.end(), trajectory.controls[k].begin(), trajectory.controls[k].end());
    out.push_back(std::move(point));
  }
  return out;
}

/// The statement on a mesh: the road where its points are, and the start.
json statement_of(const planner::LapProblem& lap, const planner::LapSettings& settings,
                  const vehicle::Parameters& vehicle, const ocp::SolveSettings& solve) {
  const ocp::Transcription transcription(lap.problem(), solve.mesh, solve.scheme);
  const auto guess = transcription.trajectory(transcription.point(solve.guess));
  std::vector<double> s;
  for (std::size_t k = 0; k < guess.tau.size(); ++k) s.push_back(guess.time(k));
  json bounds;
  const auto note = [&](const auto& list) {
    const auto number = [](double x) { return std::isfinite(x) ? json(x) : json(); };
    for (const auto& each : list)
      bounds[each.name] = {number(each.bounds.lower), number(each.bounds.upper)};
  };
  note(lap.problem().states());
  note(lap.problem().controls());
  return {{"length", lap.line().length()},
          {"intervals", solve.mesh.intervals()},
          {"w_control", settings.w_control},
          {"vehicle", numbers_of(vehicle)},
          {"bounds", bounds},
          {"road", lap.line().along(s)},
          {"guess", points_of(guess)}};
}

int run(const std::string& name, const std::string& out, int intervals) {
  const auto scenario = io::load_scenario({name, {}, {}, {}, {}});
  if (!scenario.road) throw InvalidValue(scenario.name, "no road", "a closed one", {"road"});
  const planner::LapSettings settings;
  const planner::LapProblem lap(*scenario.road, scenario.vehicle, settings);
  const auto solve = lap.solve_on(intervals);
  json file = {{"statement", statement_of(lap, settings, scenario.vehicle, solve)}};
  const Timer timer;
  const ocp::Solution solution = ocp::solve(lap.problem(), solve);
  const double cpu_s = timer.cpu();  // transcription and check included
  file["ours"] = {{"solved", solution.solved()},
                  {"status", nlp::to_string(solution.status)},
                  {"iterations", solution.iterations},
                  {"cost", solution.objective},
                  {"time_s", solution.cost_term("time")},
                  {"cpu_s", cpu_s},
                  {"points", points_of(solution.trajectory)}};
  std::ofstream(out) << file.dump() << "\n";
  return solution.solved() ? EXIT_SUCCESS : EXIT_FAILURE;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"The fastest lap on one mesh, and what it takes to solve the same elsewhere"};
  std::string scenario, out;
  int intervals = 0;
  app.add_option("scenario", scenario)->required();
  app.add_option("out", out)->required();
  app.add_option("--intervals", intervals)->required();
  CLI11_PARSE(app, argc, argv);
  try {
    return run(scenario, out, intervals);
  } catch (const std::exception& error) {
    std::cerr << "bench_lap: " << error.what() << "\n";
    return EXIT_FAILURE;
  }
}
