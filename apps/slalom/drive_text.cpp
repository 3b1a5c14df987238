#include "drive_text.hpp"

#include <fmt/format.h>

#include <cmath>

#include "slalom/sim/marks.hpp"
#include "slalom/sim/solve_times.hpp"
#include "slalom/sim/verification.hpp"

namespace slalom::app {
namespace {

/// A crash is located to rounding: what prints as -0.00 is 0.
double without_sign(double clearance) {
  return std::fabs(clearance) < 0.005 ? 0 : clearance;
}

/// Nothing for a planner that does not verify its plans.
std::string verification_text(const sim::Drive& drive) {
  const auto v = sim::verification(drive);
  if (!v || v->cycles == 0) return "";
  const int fresh = v->of(planner::Rung::new_plan);
  auto text = fmt::format(
      "  plans              {} of {} cycles verified ({} new plan{}, {} the rest of the "
      "last)\n",
      v->cycles - v->unverified, v->cycles, fresh, fresh == 1 ? "" : "s",
      v->of(planner::Rung::rest));
  if (v->unverified > 0)
    text += fmt::format(
        "  warning            {} of {} cycles without a verified plan, the first at "
        "{:.2f} s: {}\n",
        v->unverified, v->cycles, v->first_unverified_t, v->first_refused);
  return text;
}

}  // namespace

std::string drive_text(const sim::Scenario& scenario, const sim::Drive& drive) {
  auto text = fmt::format("{} with {}: {} at {:.2f} s\n", scenario.name, scenario.planner.name,
                          sim::to_string(drive.outcome), drive.time);
  if (!drive.message.empty()) text += fmt::format("  {}\n", drive.message);
  if (drive.goal_time) text += fmt::format("  goal entered       {:.2f} s\n", *drive.goal_time);
  if (std::isfinite(drive.least_clearance))
    text += fmt::format(
        "  least clearance    {:.2f} m beyond the {:g} m of a crash, to {} at {:.2f} s\n",
        without_sign(drive.least_clearance), scenario.loop.sm_crash, drive.least_clearance_obstacle,
        drive.least_clearance_t);
  text += fmt::format("  least wheel load   {:.0f} N\n", drive.least_wheel_load);
  if (std::isfinite(drive.least_edge_distance))
    text += fmt::format("  off the road's edge {:.3f} m at the least, {:.1f} m along the road\n",
                        drive.least_edge_distance, drive.progress);
  for (std::size_t lap = 0; lap < drive.lap_ends.size(); ++lap)
    text += fmt::format("  lap {:<15}{:.3f} s\n", lap + 1,
                        drive.lap_ends[lap] - (lap > 0 ? drive.lap_ends[lap - 1] : 0));

  text += verification_text(drive);
  for (const auto& mark : sim::marks(scenario, drive))
    text += fmt::format("  warning            {}\n", mark.text);

  const auto wall = sim::solve_times(drive);
  if (wall.empty()) return text;
  text += fmt::format(
      "  solve times        {} cycles, median {:.2f} ms, greatest {:.2f} ms, tex {:g} s\n",
      wall.size(), 1e3 * sim::median(wall), 1e3 * sim::greatest(wall), scenario.loop.tex);
  return text;
}

}  // namespace slalom::app
