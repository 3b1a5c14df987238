#include "progress.hpp"

#include <fmt/format.h>

namespace slalom::app {

Progress::Progress(std::string label, bool quiet) : label_(std::move(label)), line_(quiet) {}

void Progress::show(const sim::Cycle& cycle) {
  if (!line_.on()) return;
  const auto& plan = cycle.plan;
  line_.show(fmt::format("{}  t {:5.1f} s  cycle {}  solve {:.3f} s of {:g} s  {:.1f} m/s", label_,
                         cycle.t0, cycle.index, plan.report.wall_s, cycle.tex,
                         cycle.X0p[vehicle::UX]));
}

}  // namespace slalom::app
