#pragma once

#include "descent.hpp"
#include "elastic_form.hpp"

namespace slalom::nlp::ipm {

/// The feasibility restoration phase (Waechter & Biegler 2006, section 3.3): from a point where no
/// step is acceptable to one that the filter accepts with less violation, by minimising the rows'
/// elastic parts on the same stage structure.
class Restoration {
 public:
  /// `form`: of `main`.
  Restoration(SlackForm& form, Descent& main);

  enum class Outcome { restored, infeasible, failed, stopped };
  /// Whether to stop early (deadline, user, iterations), asked before each iteration; told of each
  /// iteration after it.
  class Watch {
   public:
    virtual ~Watch() = default;
    virtual bool stop() = 0;
    virtual void iterated(const Descent& restoration) = 0;
  };
  /// On `restored` and `infeasible`, the primal point of `main` is the one reached, with nothing
  /// evaluated there and the multipliers from before; otherwise `main` is as it was.
  /// `most_violation`: with which the main method may go on; `again`: it was called before in this
  /// solve.
  Outcome run(Watch& watch, double most_violation, bool again);
  /// After `infeasible`, with the derivatives at the main point known: its multipliers become those
  /// of the sum of the rows' violations, relative to that sum.
  void hand_back_multipliers();
  void give_up_at(Deadline* deadline) { inner_.give_up_at(deadline); }

 private:
  void take_over_problem();
  [[nodiscard]] bool begin();
  void set_elastic_parts(double mu);
  [[nodiscard]] bool meet_rows();
  [[nodiscard]] bool update_barrier();
  bool at_least_violation() const;
  bool accepted_by_main(double most_violation);
  void hand_back();

  Descent& main_;
  ElasticForm form_;
  Descent inner_;
  std::vector<double> misfits_;  ///< of the rows, elastic parts left out
  std::vector<double> force_;    ///< of the rows on the variables
  Point trial_;                  ///< of the main form
};

}  // namespace slalom::nlp::ipm
