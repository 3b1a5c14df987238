#include "slalom/nlp/solver.hpp"

#include <algorithm>
#include <atomic>

#include "backends.hpp"
#include "slalom/base/error.hpp"

namespace slalom::nlp {

std::uint64_t Structure::next_id() {
  static std::atomic<std::uint64_t> last{0};
  return ++last;
}

const char* to_string(Status status) {
  switch (status) {
    case Status::solved:
      return "solved";
    case Status::iteration_limit:
      return "iteration_limit";
    case Status::time_limit:
      return "time_limit";
    case Status::infeasible:
      return "infeasible";
    case Status::unbounded:
      return "unbounded";
    case Status::invalid_number:
      return "invalid_number";
    case Status::too_few_freedoms:
      return "too_few_freedoms";
    case Status::interrupted:
      return "interrupted";
    case Status::numerical_failure:
      return "numerical_failure";
  }
  return "unknown";
}

void check_sizes(const Start& start, const Structure& structure, bool with_duals) {
  const auto expect = [](const char* name, const std::vector<double>& part, std::size_t size) {
    if (part.size() != size)
      throw InvalidValue(std::string("start: ") + name, std::to_string(part.size()) + " numbers",
                         std::to_string(size));
  };
  expect("x", start.x, structure.variables);
  if (!with_duals) return;
  expect("y", start.y, structure.rows);
  expect("zl", start.zl, structure.variables);
  expect("zu", start.zu, structure.variables);
}

void note_violation(Problem& problem, Answer& answer) {
  Evaluation at;
  if (problem.evaluate(answer.point.x, 1, {}, {.values = true}, at)) return;
  for (std::size_t r = 0; r < at.rows.size(); ++r) {
    const double outside =
        std::max(problem.limits().gl[r] - at.rows[r], at.rows[r] - problem.limits().gu[r]) /
        problem.structure().row_scale[r];
    if (outside <= answer.violation) continue;
    answer.violation = outside;
    answer.worst_row = r;
  }
}

std::vector<std::string> backends() {
  std::vector<std::string> names;
  if (has_ipopt()) names.emplace_back("ipopt");
  names.emplace_back("interior_point");
#ifdef SLALOM_WITH_KNITRO
  names.emplace_back("knitro");
#endif
  return names;
}

std::unique_ptr<Solver> make_solver(const std::string& backend) {
  if (backend.empty() || backend == "interior_point") return make_interior_point();
  if (backend == "ipopt") return make_ipopt();
#ifdef SLALOM_WITH_KNITRO
  if (backend == "knitro") return make_knitro();
#endif
  if (backend == "nl") return make_nl();
  std::string have;
  for (const auto& name : backends()) have += name + ", ";
  throw InvalidValue("solver", "'" + backend + "'", "one of " + have + "nl");
}

}  // namespace slalom::nlp
