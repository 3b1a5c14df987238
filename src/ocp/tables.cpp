#include "tables.hpp"

#include <algorithm>

#include "slalom/expr/spline.hpp"
#include "slalom/ocp/values.hpp"

namespace slalom::ocp {

Tables::Tables(const Problem& problem) {
  const auto look = [&](const std::string& term, const Expr& expression) {
    auto rooms = expr::room_in_tables({expression});
    if (!rooms.empty()) uses_.push_back({term, std::move(rooms)});
  };
  for (const auto& state : problem.states()) look("dynamics of " + state.name, state.rate);
  for (const auto& cost : problem.costs())
    if (cost.enabled && !cost.moment) look("cost " + cost.name, cost.value);
  for (const auto& integral : problem.integrals())
    look("integral " + integral.name, integral.integrand);
  for (const auto& row : problem.constraints())
    if (row.enabled && (row.kind == Problem::Kind::path || row.kind == Problem::Kind::boundary))
      look("constraint " + row.name, row.value);
}

std::vector<std::pair<std::string, double>> Tables::beyond(const Problem& problem,
                                                           const Solution& solution) const {
  std::vector<std::pair<std::string, double>> result;
  for (const Use& use : uses_) {
    double beyond = 0;
    for (const Expr& room : use.rooms)
      for (const double inside : values(problem, solution, room))
        beyond = std::max(beyond, -inside);
    if (beyond > 0) result.emplace_back(use.term, beyond);
  }
  return result;
}

}  // namespace slalom::ocp
