#pragma once

#include <vector>

#include "slalom/ocp/problem.hpp"
#include "slalom/ocp/solve.hpp"

namespace slalom::ocp {

/// What goes to and fro from point to point over a stretch of the mesh. On a singular arc the cost
/// does not see a control's fastest changes, but a scheme's error does: the best answer of the
/// discretised problem makes use of it (Betts 2010, section 4.14).
struct Chatter {
  std::vector<char> controls;   ///< 1 for each that does
  std::vector<char> intervals;  ///< and where
  bool any() const;
  double share() const;  ///< of the intervals
};
/// Of controls that are damped already, fewer turns tell.
Chatter chatter_of(const Solution& solution, bool damped);

/// By phase, each control: 1 if it is meant.
using Chosen = std::vector<std::vector<char>>;

/// What is done about controls that chatter.
class Damping {
 public:
  explicit Damping(bool wanted) : wanted_(wanted) {}

  /// Relative to the objective's size; 0: none.
  double weight() const { return weight_; }
  const Chosen& chosen() const { return chosen_; }
  /// After an answer. Whether there is to be more weight next.
  bool raised(const std::vector<Chatter>& chatter);
  /// Whether the last solve was the first with less weight than the one before.
  bool lowered() const { return lowered_; }
  /// After a calm answer and a change of the objective by it: what may be left, by this one and the
  /// one before. It falls as one over the sum of 1 / weight (Gueler, SIAM J. Control Optim. 29(2),
  /// 1991).
  double calm(double change);
  /// Where the mesh does, and the damping alone is still seen: less weight gets there sooner.
  void lower();

 private:
  static constexpr double kFirstWeight = 0.1, kMoreWeight = 4, kMostWeight = 2;
  static constexpr double kMostly = 0.5;  ///< of a phase's intervals

  bool wanted_, chattered_ = false, lowered_ = false;
  int lowerings_ = 4;  ///< how often more it may turn out to have been too far down
  double weight_ = 0, sum_ = 0, left_ = kInfinity;
  Chosen chosen_;
};

/// A cost on how far chosen controls are from an earlier answer's: weight times the mean over the
/// horizon of ((u - earlier u) / range)^2, where a control is 1 in `chosen`. Solved again and
/// again, each time about the last answer, it ends where the cost alone is least, for there it is 0
/// (Rockafellar, SIAM J. Control Optim. 14(5), 1976; for singular arcs Pager & Rao, Comput. Optim.
/// Appl. 81, 2022). Where a control chatters, its average over neighbouring intervals stands for
/// it.
void add_damping(Problem& problem, const Solution& earlier, const std::vector<char>& chosen,
                 double weight);

/// Makes of an answer to the damped problem one to the problem as it was stated, in place: its
/// multipliers stay those of the damped problem. Returns what the damping cost.
double without_damping(Solution& solution);

}  // namespace slalom::ocp
