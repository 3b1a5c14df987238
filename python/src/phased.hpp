#pragma once

#include <memory>
#include <string>
#include <vector>

#include "binding.hpp"
#include "settings.hpp"
#include "slalom/ocp/phases.hpp"
#include "solved.hpp"

namespace slalom::python {

/// What Python knows as PhasedProblem: its phases are Python's own problems, so that rows added to
/// one of them later count.
class Phases : public ocp::PhasedProblem {
 public:
  using PhasedProblem::PhasedProblem;

  std::size_t add_live(std::shared_ptr<ocp::Problem> phase) {
    const auto number = add(*phase);
    live_.push_back(std::move(phase));
    return number;
  }
  void replace_live(std::size_t number, std::shared_ptr<ocp::Problem> phase) {
    replace(number, *phase);
    live_[number] = std::move(phase);
  }
  /// Its phases as they are now become what C++ sees.
  void take_over() {
    for (std::size_t p = 0; p < live_.size(); ++p) replace(p, *live_[p]);
  }
  ocp::PhasedProblem now() const {
    Phases copy = *this;
    copy.take_over();
    return copy;
  }

 private:
  std::vector<std::shared_ptr<ocp::Problem>> live_;
};

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
