#pragma once

#include <memory>
#include <string>
#include <vector>

#include "slalom/base/error.hpp"
#include "slalom/ocp/interpolant.hpp"
#include "slalom/ocp/sensitivity.hpp"
#include "slalom/ocp/simulate.hpp"
#include "slalom/ocp/solve.hpp"

namespace slalom::python {

/// A name that is not there: Python's KeyError as well as InvalidValue.
class UnknownName : public InvalidValue {
 public:
  explicit UnknownName(const InvalidValue& reason) : InvalidValue(reason) {}
};

/// Calls a look-up by name; what it throws becomes an UnknownName.
template <class Lookup>
auto named(const Lookup& lookup) {
  try {
    return lookup();
  } catch (const InvalidValue& reason) {
    throw UnknownName(reason);
  }
}

/// What Python knows as Solution: the answer with the problem it answers, as that was then.
struct Solved {
  std::shared_ptr<const ocp::Problem> problem;
  ocp::Solution answer;
  double elapsed_s = 0;             ///< of the C++ call as a whole; of a phase, of all
  std::vector<Solved> starts = {};  ///< all answers, where several starts were asked for

  /// Made when first asked for.
  const ocp::Interpolant& between() const {
    if (!interpolant_)
      interpolant_ = std::make_shared<const ocp::Interpolant>(*problem, answer.trajectory,
                                                              answer.mesh, answer.scheme);
    return *interpolant_;
  }
  /// Likewise.
  const ocp::Sensitivities& sensitivities() const {
    if (!sensitivities_)
      sensitivities_ = std::make_shared<const ocp::Sensitivities>(*problem, answer);
    return *sensitivities_;
  }

 private:
  mutable std::shared_ptr<const ocp::Interpolant> interpolant_;
  mutable std::shared_ptr<const ocp::Sensitivities> sensitivities_;
};

/// Warns of tables used beyond their ends, and of equations of a high index in what is not solved.
void warn_of(const ocp::Problem& problem, const ocp::Solution& answer);

/// What Python knows as Simulation: with the problem whose dynamics were integrated.
struct Simulated {
  std::shared_ptr<const ocp::Problem> problem;
  ocp::Simulation answer;
};

/// What Python knows as PhasedSolution: the phases' answers stand in `phases`, not in `answer`.
struct PhasedSolved {
  std::shared_ptr<const ocp::PhasedProblem> problem;  ///< as it was then
  ocp::PhasedSolution answer;
  std::vector<Solved> phases;
  double elapsed_s = 0;
  std::vector<PhasedSolved> starts = {};

  PhasedSolved() = default;
  PhasedSolved(const ocp::PhasedProblem& problem, ocp::PhasedSolution solution, double elapsed);
  /// As C++ has it.
  ocp::PhasedSolution whole() const;
  /// Made when first asked for.
  const ocp::PhasedSensitivities& sensitivities() const {
    if (!sensitivities_)
      sensitivities_ = std::make_shared<const ocp::PhasedSensitivities>(*problem, whole());
    return *sensitivities_;
  }

 private:
  mutable std::shared_ptr<const ocp::PhasedSensitivities> sensitivities_;
};

/// Whether both stand on the same mesh, by the same schemes.
bool same_grid(const ocp::Solution& answer, const ocp::PhasedTranscription::Grid& grid);

}  // namespace slalom::python
