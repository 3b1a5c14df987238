// Any solver that reads AMPL's .nl files: write one, run the solver, read what it answered.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>

#include "../backends.hpp"
#include "dialect.hpp"
#include "nl_file.hpp"
#include "process.hpp"
#include "slalom/base/error.hpp"
#include "slalom/base/timer.hpp"
#include "sol_file.hpp"

namespace slalom::nlp {
namespace {

namespace fs = std::filesystem;

void write_text(const fs::path& file, const std::string& text) {
  std::ofstream out(file, std::ios::binary);
  out << text;
  out.close();
  if (!out) throw Error(file.string() + " cannot be written");
}

std::string read_text(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

std::string last_line(const std::string& text) {
  const auto end = text.find_last_not_of(" \r\n");
  if (end == std::string::npos) return "";
  const auto begin = text.find_last_of('\n', end);
  const auto first = begin == std::string::npos ? 0 : begin + 1;
  return text.substr(first, end - first + 1);
}

/// AMPL's ranges of solve_result_num; 400 and 401 are what Ipopt and KNITRO give for iterations and
/// time, 503 and 504 Ipopt's for numbers and freedoms.
Status status_of(int result) {
  if (result >= 0 && result < 100) return Status::solved;
  if (result >= 200 && result < 300) return Status::infeasible;
  if (result >= 300 && result < 400) return Status::unbounded;
  if (result == 401) return Status::time_limit;
  if (result >= 400 && result < 500) return Status::iteration_limit;
  if (result == 503) return Status::invalid_number;
  if (result == 504) return Status::too_few_freedoms;
  return Status::numerical_failure;
}

/// to[index[k]] = sign * from[k]
void put_back(const std::vector<double>& from, const std::vector<std::uint32_t>& index, double sign,
              std::vector<double>& to) {
  for (std::size_t k = 0; k < from.size(); ++k) to[index[k]] = sign * from[k];
}

/// Gradient of f + sign * y' g at the point; empty where a function has a fault.
std::vector<double> lagrangian_gradient(Problem& problem, const Start& point, double sign) {
  Evaluation at;
  if (problem.evaluate(point.x, 1, {}, {.values = true, .derivatives = true}, at)) return {};
  const Structure& shape = problem.structure();
  for (std::size_t e = 0; e < at.jacobian.size(); ++e)
    at.gradient[shape.jacobian_col[e]] += sign * point.y[shape.jacobian_row[e]] * at.jacobian[e];
  return at.gradient;
}

/// Of the gradient, what no bound nearby can hold.
double unheld(const Limits& limits, const std::vector<double>& x,
              const std::vector<double>& gradient) {
  constexpr double kNear = 1e-4;
  double sum = 0;
  for (std::size_t i = 0; i < gradient.size(); ++i) {
    const double near = kNear * (1 + std::fabs(x[i]));
    const bool held = gradient[i] > 0 ? x[i] < limits.xl[i] + near : x[i] > limits.xu[i] - near;
    if (!held) sum += std::fabs(gradient[i]);
  }
  return sum;
}

/// AMPL's sign of a row's multiplier is the opposite of Start's, but not every solver keeps to it:
/// turns them where that is nearer to stationarity.
void settle_sign(Problem& problem, Start& point) {
  const auto as_ampl = lagrangian_gradient(problem, point, 1);
  const auto turned = lagrangian_gradient(problem, point, -1);
  if (unheld(problem.limits(), point.x, turned) < unheld(problem.limits(), point.x, as_ampl))
    for (auto& number : point.y) number = -number;
}

/// What stationarity leaves to the bounds, for solvers that do not tell.
void infer_bound_multipliers(Problem& problem, Start& point) {
  const auto gradient = lagrangian_gradient(problem, point, 1);
  for (std::size_t i = 0; i < gradient.size(); ++i) {
    if (std::isfinite(problem.limits().xl[i])) point.zl[i] = std::max(gradient[i], 0.0);
    if (std::isfinite(problem.limits().xu[i])) point.zu[i] = std::max(-gradient[i], 0.0);
  }
}

class NlSolver final : public Solver {
 public:
  void solve(Problem& problem, const Start& start, const Options& options,
             Answer& answer) override {
    const Timer timer;
    check_sizes(start, problem.structure(), options.warm_start);
    check(options, "solver options");
    const auto formulas = problem.formulas();
    if (!formulas)
      throw InvalidValue("solver nl", "a problem that gives numbers alone",
                         "one that gives its formulas, as transcriptions do");
    const fs::path executable = find_executable(options.nl_solver);
    if (executable.empty())
      throw InvalidValue("solver options: nl_solver", "'" + options.nl_solver + "'",
                         "an executable that reads .nl files, in PATH or as a path");
    const auto words = command_words(executable.filename().string(), options);
    const NlFile file = nl_file(*formulas, problem.limits(), start, options.warm_start);
    Start point = start;  // which may be the answer's own
    answer = {};
    answer.backend = "nl, " + executable.filename().string();
    answer.point = std::move(point);
    answer.point.y.assign(problem.structure().rows, 0.0);
    answer.point.zl.assign(problem.structure().variables, 0.0);
    answer.point.zu.assign(problem.structure().variables, 0.0);
    const TemporaryFolder folder;
    write_text(folder.path() / "problem.nl", file.text);
    std::vector<std::string> command{executable.string(), "problem.nl", "-AMPL"};
    command.insert(command.end(), words.begin(), words.end());
    const auto end = run(command, folder.path(), options, timer, answer);
    if (!end.stopped) read(problem, file, folder.path(), end, answer);
    note_objective(problem, answer);
    answer.cpu_s = timer.cpu() + end.cpu_s;
    answer.wall_s = timer.wall();
  }

 private:
  static ProcessEnd run(const std::vector<std::string>& command, const fs::path& folder,
                        const Options& options, const Timer& timer, Answer& answer) {
    // By the clock too: a solver that waits for something would never end by its processor time.
    const auto stop = [&](double cpu_s) {
      if (std::max(cpu_s, timer.wall()) > options.time_limit)
        answer.status = Status::time_limit;
      else if (options.stop != nullptr && options.stop(options.stop_data))
        answer.status = Status::interrupted;
      else
        return false;
      return true;
    };
    return run_process(command, folder, options.print_level > 0 ? fs::path() : folder / "log",
                       stop);
  }

  static void read(Problem& problem, const NlFile& file, const fs::path& folder,
                   const ProcessEnd& end, Answer& answer) {
    const fs::path sol_path = folder / "problem.sol";
    if (!fs::exists(sol_path)) {
      answer.message = fmt::format("no .sol file; the solver ended with code {}: {}", end.exit_code,
                                   last_line(read_text(folder / "log")));
      return;
    }
    SolFile sol;
    try {
      sol = read_sol(read_text(sol_path), file.variables.size(), file.rows.size(), "problem.sol");
    } catch (const InvalidValue& error) {
      answer.message = error.what();
      return;
    }
    answer.message = sol.message;
    answer.status = status_of(sol.result);
    if (sol.x.empty() && answer.status == Status::solved) {
      answer.status = Status::numerical_failure;
      answer.message = "solved by its own account, but problem.sol has no values";
    }
    put_back(sol.x, file.variables, 1, answer.point.x);
    put_back(sol.y, file.rows, -1, answer.point.y);
    settle_sign(problem, answer.point);
    const auto lower = sol.variable_suffixes.find("ipopt_zL_out");
    const auto upper = sol.variable_suffixes.find("ipopt_zU_out");
    if (lower == sol.variable_suffixes.end() || upper == sol.variable_suffixes.end())
      return infer_bound_multipliers(problem, answer.point);
    put_back(lower->second, file.variables, 1, answer.point.zl);
    put_back(upper->second, file.variables, -1, answer.point.zu);
  }

  static void note_objective(Problem& problem, Answer& answer) {
    Evaluation at;
    if (problem.evaluate(answer.point.x, 1, {}, {.values = true}, at)) return;
    answer.objective = at.objective;
    note_violation(problem, answer);
  }
};

}  // namespace

std::unique_ptr<Solver> make_nl() {
  return std::make_unique<NlSolver>();
}

}  // namespace slalom::nlp
