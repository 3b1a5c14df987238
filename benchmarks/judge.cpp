// Judges answers that peers gave for recorded cycles, by nlp::check. JSON on standard output.
//
//   bench_judge --cycles FILE --environment E_C --answers FILE --floor MU
//
// Answers are doubles: for each the arrays cycle, x, y, zl, zu, each after its length, user's
// units, in the order of our names (cycles.py). A peer without our lifted copies leaves NaN there:
// a copy is its original, and the multiplier of its equation follows from the copy's stationarity.

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "cycle_file.hpp"
#include "slalom/base/error.hpp"
#include "slalom/nlp/check.hpp"

namespace {

using namespace slalom;
using nlohmann::json;

struct Peer {
  std::size_t cycle = 0;
  nlp::Start point;
};

bool read_array(std::ifstream& file, std::vector<double>& values) {
  double size = 0;
  if (!file.read(reinterpret_cast<char*>(&size), sizeof size)) return false;
  values.resize(static_cast<std::size_t>(size));
  const auto bytes = static_cast<std::streamsize>(values.size() * sizeof(double));
  if (!file.read(reinterpret_cast<char*>(values.data()), bytes))
    throw InvalidValue("answers", "an early end", "whole arrays");
  return true;
}

std::vector<Peer> read_answers(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw InvalidValue(path, "no file", "answers of a peer");
  std::vector<Peer> answers;
  std::vector<double> cycle;
  while (read_array(file, cycle)) {
    Peer& peer = answers.emplace_back();
    peer.cycle = static_cast<std::size_t>(cycle.at(0));
    for (auto* part : {&peer.point.x, &peer.point.y, &peer.point.zl, &peer.point.zu})
      if (!read_array(file, *part)) throw InvalidValue(path, "an early end", "whole arrays");
  }
  return answers;
}

void into_own_units(nlp::Start& point, const nlp::Structure& shape) {
  for (std::size_t i = 0; i < shape.variables; ++i) {
    point.x[i] /= shape.variable_scale[i];
    point.zl[i] *= shape.variable_scale[i];
    point.zu[i] *= shape.variable_scale[i];
  }
  for (std::size_t r = 0; r < shape.rows; ++r) point.y[r] /= shape.row_scale[r];
}

/// Fills in the NaNs: t0 is fixed, every other one belongs to a lifted copy.
void fill_copies(nlp::Problem& problem, nlp::Start& point) {
  const auto& shape = problem.structure();
  for (std::size_t i = 0; i < shape.variables; ++i)
    if (std::isnan(point.x[i]) && problem.limits().xl[i] == problem.limits().xu[i])
      point.x[i] = problem.limits().xl[i];
  const std::vector<double> given = point.x;
  for (double& value : point.x)
    if (std::isnan(value)) value = 0;
  nlp::Evaluation at;
  problem.evaluate(point.x, 1, {}, {.values = true, .derivatives = true}, at);
  std::vector<char> is_copy_row(shape.rows, 0);
  for (std::size_t r = 0; r < shape.rows; ++r)
    if (std::isnan(point.y[r])) {
      is_copy_row[r] = 1;
      point.y[r] = 0;
    }
  const auto each_copy = [&](auto visit) {  // entry, its row, the copy: its row's one unknown
    for (std::size_t e = 0; e < shape.jacobian_row.size(); ++e)
      if (is_copy_row[shape.jacobian_row[e]] && std::isnan(given[shape.jacobian_col[e]]))
        visit(e, shape.jacobian_row[e], shape.jacobian_col[e]);
  };
  each_copy([&](std::size_t e, std::size_t r, std::size_t i) {  // the row at copy = 0 is known
    point.x[i] = (problem.limits().gl[r] - at.rows[r]) / at.jacobian[e];
  });
  problem.evaluate(point.x, 1, {}, {.values = true, .derivatives = true}, at);
  std::vector<double> slope = at.gradient;
  for (std::size_t e = 0; e < shape.jacobian_row.size(); ++e)
    slope[shape.jacobian_col[e]] += point.y[shape.jacobian_row[e]] * at.jacobian[e];
  each_copy([&](std::size_t e, std::size_t r, std::size_t i) {
    point.y[r] = -slope[i] / at.jacobian[e];
  });
}

json judge(bench::PlannerCycle& planner, const std::vector<bench::Cycle>& cycles, Peer peer,
           const nlp::Options& options) {
  const auto& cycle = cycles.at(peer.cycle);
  bench::Form& form = planner.form(cycle.in_range);
  form.update(cycle.request);
  into_own_units(peer.point, form.transcription.structure());
  fill_copies(form.transcription, peer.point);
  for (auto* part : {&peer.point.zl, &peer.point.zu})
    for (double& value : *part)
      if (std::isnan(value)) value = 0;
  const auto residuals = nlp::check(form.transcription, peer.point, options);
  json result = bench::describe(residuals, form.transcription.trajectory(peer.point.x));
  result["cycle"] = peer.cycle;
  return result;
}

}  // namespace

int main(int argc, char** argv) try {
  std::string environment = "E_C", cycles_path, answers_path;
  nlp::Options options;
  CLI::App app("Judges answers that peers gave for recorded cycles.");
  app.add_option("--environment", environment, "E_B, E_C, ...");
  app.add_option("--cycles", cycles_path, "of bench_record")->required();
  app.add_option("--answers", answers_path, "of a peer")->required();
  app.add_option("--floor", options.floor, "barrier floor; 0 for none");
  CLI11_PARSE(app, argc, argv);
  bench::PlannerCycle planner(bench::load(environment, 0.5));
  const auto cycles = bench::read_cycles(cycles_path, planner);
  json result = json::array();
  for (auto& answer : read_answers(answers_path))
    result.push_back(judge(planner, cycles, std::move(answer), options));
  std::cout << result.dump() << "\n";
  return 0;
} catch (const std::exception& error) {
  std::cerr << "bench_judge: " << error.what() << "\n";
  return 1;
}
