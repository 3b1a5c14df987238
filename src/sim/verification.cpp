#include "slalom/sim/verification.hpp"

#include <algorithm>

namespace slalom::sim {

std::optional<Verification> verification(const Drive& drive) {
  const bool verifies = std::any_of(drive.cycles.begin(), drive.cycles.end(), [](const auto& c) {
    return c.plan.rung != planner::Rung::none;
  });
  if (!verifies) return std::nullopt;
  Verification count;
  for (const auto& cycle : drive.cycles) {
    if (cycle.index == 0) continue;
    ++count.cycles;
    ++count.of_rung.at(static_cast<std::size_t>(cycle.plan.rung));
    if (cycle.plan.certificate.verified) continue;
    if (count.unverified++ > 0) continue;
    count.first_unverified_t = cycle.t_swap;
    count.first_refused = cycle.plan.report.status_text();
  }
  return count;
}

}  // namespace slalom::sim
