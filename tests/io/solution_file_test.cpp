#include "slalom/io/solution_file.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <functional>
#include <limits>
#include <nlohmann/json.hpp>

#include "io/files.hpp"
#include "slalom/base/error.hpp"
#include "slalom/io/drive_files.hpp"
#include "slalom/ocp/solve.hpp"

namespace slalom::io {
namespace {

using ocp::Bounds;
using ocp::Expr;

/// Something of everything: parameters, slacks, integrals, soft rows, schemes of several kinds.
ocp::Problem rich() {
  ocp::Problem p("rich");
  const Expr x = p.state("x", {-5, 5}, 2), v = p.state("speed, lateral");
  const Expr u = p.control("u", {-3, 3});
  const Expr k = p.static_parameter("k", {0.1, 2}, 1);
  const Expr miss = p.slack("miss", ocp::End::final, {0, 1}, 0.1);
  (void)p.integral("work", square(u), Bounds::at_most(40));
  p.dynamics(x, v);
  p.dynamics(v, u - 0.1 * k * v);
  p.lagrange("effort", square(u));
  p.mayer("arrival", 10 * miss + square(k - 1));
  p.initial_bounds(x, Bounds::equal(0));
  p.initial_bounds(v, Bounds::equal(0));
  (void)p.boundary("there", p.final(x) + miss, Bounds::at_least(1));
  (void)p.path("slow", v, Bounds::at_most(1.4));
  p.final_time({0.5, 2}, 1);
  return p;
}

ocp::Solution solved() {
  ocp::SolveSettings settings;
  settings.mesh = ocp::Mesh({0, 0.1, 0.5, 1});
  settings.scheme = ocp::Schemes({ocp::hermite_simpson(), ocp::lgr(4), ocp::hermite_simpson()});
  settings.options.tol = 1e-9;
  settings.options.time_limit = std::numeric_limits<double>::infinity();
  return ocp::solve(rich(), settings);
}

ocp::PhasedProblem two_phases() {
  ocp::PhasedProblem both("both");
  ocp::Problem first("first"), second("second");
  for (auto* p : {&first, &second}) {
    const Expr x = p->state("x"), u = p->control("u");
    p->dynamics(x, u);
    p->lagrange("effort", square(u) + square(x));
    if (p == &first) {
      p->initial_bounds(x, Bounds::equal(1));
    } else {
      p->initial_time(Bounds::equal(1), 1);
      p->final_time(Bounds::equal(2), 2);
      p->final_bounds(x, Bounds::equal(2));
    }
  }
  both.add(first);
  both.add(second);
  both.connect(0, 1);
  both.mayer("ends", square(first.states()[0].final_symbol));
  return both;
}

class SolutionFile : public testing::Test {
 protected:
  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  std::string written(const std::string& text) const {
    write_file(path("damaged"), text);
    return path("damaged");
  }

  test::TemporaryFolder folder_;
};

std::string refusal(const std::function<void()>& f) {
  try {
    f();
  } catch (const InvalidValue& error) {
    return error.what();
  }
  return "accepted";
}

bool same_bits(const std::vector<double>& a, const std::vector<double>& b) {
  return a.size() == b.size() &&
         (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0);
}

TEST_F(SolutionFile, IsReadBackToTheSameBits) {
  const auto solution = solved();
  ASSERT_TRUE(solution.solved()) << solution.residuals.worst_constraint;
  save_solution(path("a.json"), solution);
  const auto again = read_solution(path("a.json"));
  EXPECT_EQ(to_json(again), to_json(solution));
  EXPECT_TRUE(again.solved());
  EXPECT_TRUE(same_bits(again.point.x, solution.point.x));
  EXPECT_TRUE(same_bits(again.point.y, solution.point.y));
  EXPECT_TRUE(same_bits(again.point.zl, solution.point.zl));
  EXPECT_TRUE(same_bits(again.trajectory.tau, solution.trajectory.tau));
  EXPECT_TRUE(same_bits(again.state("speed, lateral"), solution.state("speed, lateral")));
  EXPECT_TRUE(same_bits(again.costate("x"), solution.costate("x")));
  EXPECT_EQ(again.trajectory.integrals, solution.trajectory.integrals);
  EXPECT_EQ(again.static_parameter("k"), solution.static_parameter("k"));
  EXPECT_EQ(again.multiplier("slow").points, solution.multiplier("slow").points);
  EXPECT_TRUE(same_bits(again.multiplier("slow").values, solution.multiplier("slow").values));
  EXPECT_EQ(again.scheme.of(1).points, ocp::lgr(4).points);
  EXPECT_TRUE(std::isinf(again.options.time_limit));
  EXPECT_EQ(again.scales, solution.scales);
  EXPECT_FALSE(again.scales.empty());
}

TEST_F(SolutionFile, KeepsWhatIsSaidOfAnAnswerThatIsNotSolved) {
  ocp::Solution solution = solved();
  solution.conflicts = {{"slow", -0.25}, {"there", 0.5}};
  solution.high_index = {{"length", 3}};
  save_solution(path("a.json"), solution);
  const auto again = read_solution(path("a.json"));
  ASSERT_EQ(again.conflicts.size(), 2u);
  EXPECT_EQ(again.conflicts[1].name, "there");
  EXPECT_EQ(again.conflicts[0].change, -0.25);
  ASSERT_EQ(again.high_index.size(), 1u);
  EXPECT_EQ(again.high_index[0].name, "length");
  EXPECT_EQ(again.high_index[0].index, 3);
}

TEST_F(SolutionFile, StartsSolvesAsTheSolutionItselfDoes) {
  const auto solution = solved();
  save_solution(path("a.json"), solution);
  const auto read = read_solution(path("a.json"));
  const auto solve_from = [](const ocp::Solution& from, bool other_mesh) {
    ocp::SolveSettings settings;
    settings.mesh = other_mesh ? ocp::Mesh::uniform(8) : from.mesh;
    settings.scheme = other_mesh ? ocp::Schemes(ocp::lgr(3)) : from.scheme;
    settings.options = from.options;
    if (other_mesh)
      settings.previous = &from;
    else
      settings.warm_start = from.point;
    return ocp::solve(rich(), settings);
  };
  for (const bool other_mesh : {false, true}) {
    const auto ours = solve_from(solution, other_mesh), theirs = solve_from(read, other_mesh);
    EXPECT_TRUE(theirs.solved());
    EXPECT_TRUE(same_bits(theirs.point.x, ours.point.x));
    EXPECT_EQ(theirs.iterations, ours.iterations);
    EXPECT_LT(theirs.iterations, solution.iterations);
  }
}

TEST_F(SolutionFile, KeepsPhasesAndLinks) {
  const auto solution = ocp::solve(two_phases());
  ASSERT_TRUE(solution.solved());
  save_solution(path("p.json"), solution);
  const auto again = read_phased_solution(path("p.json"));
  EXPECT_EQ(to_json(again), to_json(solution));
  ASSERT_EQ(again.phases.size(), 2u);
  EXPECT_EQ(again.link_multipliers, solution.link_multipliers);
  ASSERT_EQ(again.cost_terms.size(), 1u);
  EXPECT_EQ(again.cost_terms, solution.cost_terms);
  EXPECT_TRUE(same_bits(again.phases[1].state("x"), solution.phases[1].state("x")));
  EXPECT_NE(refusal([&] { (void)read_solution(path("p.json")); })
                .find("p.json: format: found 'slalom solution of phases 1', expected 'slalom "
                      "solution 1'"),
            std::string::npos);
}

TEST_F(SolutionFile, KeepsFailuresWithNumbersThatAreNotFinite) {
  ocp::Problem p("log");
  const Expr x = p.state("x");
  p.dynamics(x, log(x));
  p.initial_bounds(x, Bounds::equal(-1));
  const auto solution = ocp::solve(p);
  ASSERT_EQ(solution.status, nlp::Status::invalid_number);
  save_solution(path("f.json"), solution);
  const auto again = read_solution(path("f.json"));
  EXPECT_EQ(to_json(again), to_json(solution));
  EXPECT_TRUE(std::isnan(again.residuals.violation));
  EXPECT_EQ(again.fault.function, solution.fault.function);
}

ocp::Solution not_begun() {
  ocp::SolveSettings settings;
  settings.mesh = ocp::Mesh::uniform(3);
  settings.options.time_limit = 0;
  return ocp::solve(rich(), settings);
}

TEST_F(SolutionFile, KeepsAnAnswerWhoseSolveDidNotBegin) {
  const auto solution = not_begun();
  ASSERT_TRUE(solution.costates.empty());
  save_solution(path("stopped.json"), solution);
  const auto again = read_solution(path("stopped.json"), rich());
  EXPECT_EQ(to_json(again), to_json(solution));
  // It has a trajectory, and no costates.
  write_file(path("stopped.csv"), to_csv(again));
  EXPECT_EQ(read_trajectory(path("stopped.csv"), rich()).states, solution.trajectory.states);
  EXPECT_NE(to_csv(solution).find(",,\n"), std::string::npos);

  ocp::PhasedSettings settings;
  settings.options.time_limit = 0;
  settings.grids.resize(2);
  const auto phased = ocp::solve(two_phases(), settings);
  ASSERT_TRUE(phased.phases[1].costates.empty());
  save_solution(path("phased.json"), phased);
  EXPECT_EQ(to_json(read_phased_solution(path("phased.json"))), to_json(phased));
  EXPECT_FALSE(to_csv(phased.phases[1]).empty());
}

TEST_F(SolutionFile, AnAnswerOfAnotherProblemIsRefused) {
  save_solution(path("a.json"), solved());
  const auto expect = [&](const ocp::Problem& problem, const std::string& message) {
    const auto found = refusal([&] { (void)read_solution(path("a.json"), problem); });
    EXPECT_NE(found.find(message), std::string::npos) << found;
  };
  EXPECT_EQ(refusal([&] { (void)read_solution(path("a.json"), rich()); }), "accepted");
  const auto other = [](const char* speed, const char* control, const char* parameter,
                        const char* slack, const std::vector<const char*>& integrals) {
    ocp::Problem p("other");
    (void)p.state("x");
    (void)p.state(speed);
    const Expr u = p.control(control);
    (void)p.static_parameter(parameter, {}, 1);
    (void)p.slack(slack, ocp::End::final, {});
    for (const char* name : integrals) (void)p.integral(name, u);
    return p;
  };
  const char* v = "speed, lateral";
  EXPECT_EQ(
      refusal([&] { (void)read_solution(path("a.json"), other(v, "u", "k", "miss", {"work"})); }),
      "accepted");
  expect(other("v", "u", "k", "miss", {"work"}),
         "another problem, with the states x, speed, lateral, expected those of other: x, v");
  expect(other(v, "w", "k", "miss", {"work"}), "with the controls u, expected those of other: w");
  expect(other(v, "u", "c", "miss", {"work"}), "with the static parameters k");
  expect(other(v, "u", "k", "far", {"work"}), "with the slacks miss");
  expect(other(v, "u", "k", "miss", {"heat"}),
         "with the integrals work, expected those of other: heat");
  expect(other(v, "u", "k", "miss", {"work", "heat"}), "an answer with 1 integrals, expected 2");
}

/// `text` with the first `from` replaced.
std::string with(std::string text, const std::string& from, const std::string& to) {
  const auto at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

TEST_F(SolutionFile, DamageIsRefusedByPlaceAndRule) {
  const auto text = to_json(solved());
  const auto expect = [&](const std::string& damaged, const std::string& message) {
    const auto found = refusal([&] { (void)read_solution(written(damaged)); });
    EXPECT_NE(found.find(message), std::string::npos) << found;
  };
  EXPECT_NE(refusal([&] { (void)read_solution(path("none")); }).find("no such file"),
            std::string::npos);
  expect("", "found no valid JSON");
  expect(text.substr(0, text.size() / 2), "found no valid JSON");
  expect("[]", "found no 'format'");
  expect(with(text, "slalom solution 1", "slalom solution 9"), "found 'slalom solution 9'");
  expect(with(text, "\"tau\":[0.0,", "\"tau\":["), "one for each tau");
  expect(with(text, "\"mesh\":[0.0,0.1,", "\"mesh\":[0.0,0.7,"), "mesh: found");
  expect(with(text, "\"scheme_of_interval\":[0,1,0]", "\"scheme_of_interval\":[0,2,0]"),
         "scheme_of_interval[1]: found 2, expected the number of one of 2 schemes");
  expect(with(text, "\"scheme_of_interval\":[0,1,0]", "\"scheme_of_interval\":[0,0,0]"),
         "trajectory.tau: found");
  expect(with(text, "\"state_units\":[", "\"state_units\":[1.0,"), "state_units: found 3");
  expect(with(text, "\"status\":\"solved\"", "\"status\":\"fine\""), "status: found \"fine\"");
  expect(with(text, "\"tol\":1e-09", "\"tol\":-1.0"), "tol");
  expect(with(text, "\"costates\":[[", "\"costates\":[[1.0,"),
         "costates[0]: found 3 numbers, expected 2");
  const auto json = nlohmann::ordered_json::parse(text);
  const auto damaged = [&](const std::function<void(nlohmann::ordered_json&)>& damage) {
    auto copy = json;
    damage(copy);
    return copy.dump();
  };
  expect(damaged([](auto& j) { j["costates"] = nlohmann::ordered_json::array(); }),
         "costates: found 0 of the mesh's nodes, expected 4");
  // Points are looked up in the trajectory.
  expect(damaged([](auto& j) { j["multipliers"][1]["points"][2] = 1000; }),
         "multipliers[1].points[2]: found 1000, expected one of 9 points, from 0");
  expect(damaged([](auto& j) { j["multipliers"][1]["values"].erase(0); }),
         "multipliers[1].values: found");
  write_file(path("short.json"), damaged([](auto& j) { j["trajectory"]["integrals"].clear(); }));
  const auto found = refusal([&] { (void)read_solution(path("short.json"), rich()); });
  EXPECT_NE(found.find("an answer with 0 integrals, expected 1, as rich has"), std::string::npos)
      << found;
}

TEST_F(SolutionFile, ATableIsAGuessOfTheSameBits) {
  const auto solution = solved();
  const auto csv = to_csv(solution);
  EXPECT_EQ(csv.substr(0, csv.find('\n')),
            "t,tau,x,\"speed, lateral\",u,costate x,\"costate speed, lateral\"");
  write_file(path("a.csv"), csv);
  const auto guess = read_trajectory(path("a.csv"), rich());
  ASSERT_EQ(guess.tau.size(), solution.trajectory.tau.size());
  for (std::size_t k = 0; k < guess.tau.size(); ++k) {
    EXPECT_TRUE(same_bits(guess.states[k], solution.trajectory.states[k]));
    EXPECT_TRUE(same_bits(guess.controls[k], solution.trajectory.controls[k]));
  }
  EXPECT_EQ(guess.tf, solution.trajectory.tf);
  // As an editor or a spreadsheet leaves it.
  write_file(path("b.csv"), "\xEF\xBB\xBF" + csv + "\n \n");
  EXPECT_EQ(read_trajectory(path("b.csv"), rich()).states, guess.states);
  // Costates stand at the mesh's nodes alone: four rows of nine end without an empty cell.
  std::size_t full = 0, rows = 0;
  for (std::size_t at = csv.find('\n'); at + 1 < csv.size(); at = csv.find('\n', at + 1)) {
    ++rows;
    full += csv[csv.find('\n', at + 1) - 1] != ',' ? 1 : 0;
  }
  EXPECT_EQ(rows, solution.trajectory.tau.size());
  EXPECT_EQ(full, 4u);
}

TEST_F(SolutionFile, DamagedTablesAreRefusedByLine) {
  const auto expect = [&](const std::string& text, const std::string& message) {
    const auto found = refusal([&] { (void)read_trajectory(written(text), rich()); });
    EXPECT_NE(found.find(message), std::string::npos) << found;
  };
  const std::string header = "t,x,\"speed, lateral\",u\n";
  expect("", ":1: found no column 't'");
  expect("t,x,\"speed, laterl\",u\n", "perhaps 'speed, laterl' is meant");
  expect(header + "0,1,2,3\n", "found 1 rows of numbers, expected at least 2");
  expect(header + "0,1,2,3\n1,1,nan,3\n", ":3: speed, lateral: found 'nan'");
  expect(header + "0,1,2\n", ":2: u: found too few cells");
  expect(header + "0,1,2,3\n0,1,2,3\n", ":3: found t = 0 after 0, expected rising times");
}

}  // namespace
}  // namespace slalom::io
