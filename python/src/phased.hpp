#pragma once

#include <memory>
#include <string>
#include <vector>

#include "binding.hpp"
#include "settings.hpp"
#include "slalom/ocp/phases.hpp"
#include "solved.hpp"

namespace slalom::python {

/// What PhasedProblem.solve's keywords come to, with what the settings point to.
struct PhasedStart {
  ocp::PhasedSettings settings;
  std::unique_ptr<const ocp::PhasedSolution> previous;
};

/// `all` holds for the phases that have nothing of their own in `phases`, a dict by phase of mesh,
/// scheme, points and guess.
PhasedStart start_of(const ocp::PhasedProblem& problem, const GridChoice& all,
                     const nb::dict& phases, const std::string& backend, const PhasedSolved* guess,
                     const PhasedSolved* warm_start, const nb::kwargs& options,
                     const std::vector<std::string>& keywords = {});

}  // namespace slalom::python
