#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "slalom/ocp/problem.hpp"
#include "slalom/ocp/simulate.hpp"
#include "slalom/ocp/solve.hpp"
#include "slalom/ocp/trajectory.hpp"

namespace slalom::ocp {

/// States on straight lines between the bounds given at both ends (or the bounds' middle), controls
/// in the middle of their bounds; t0 and tf as the problem guesses them.
Trajectory straight_guess(const Problem& problem);

/// The same, but states with bounds at only one end stay constant at that value. solve() begins
/// with it if a function is not finite on the straight guess, for example because a volume or a
/// mass goes to 0 there.
Trajectory held_guess(const Problem& problem);

/// Throws InvalidValue unless `guess` fits `problem`: as many states and controls at each point as
/// the problem has, no more static parameters, slacks and integrals than it has, finite numbers,
/// taus that do not fall, tf not before t0.
void check_guess(const Trajectory& guess, const Problem& problem);

/// How an earlier answer becomes a guess.
struct Carry {
  /// Pairs of a name here and the name in the earlier problem, where these differ.
  std::map<std::string, std::string> names = {};
  /// Take values at equal times instead of equal taus; beyond the answer's ends, those of the
  /// nearer end. t0 and tf are not taken.
  bool by_time = false;
};

/// Builds a guess, variable by variable and by name. It begins as straight_guess, and each call
/// replaces the named variables. Use it as a Trajectory:
///
///   solve(problem, {.guess = Guess(problem).line("x", 0, 10).constant("u", 1)})
///
/// A name that the problem lacks throws InvalidValue, which names the nearest.
class Guess {
 public:
  /// `points`: the number of equally spaced points at which functions are sampled. Throws
  /// InvalidValue below 2.
  explicit Guess(const Problem& problem, int points = 101);

  Guess& times(double t0, double tf);
  /// One number for a state or control, or for a static parameter, slack or integral.
  Guess& constant(const std::string& name, double value);
  /// A line over time for a state or control.
  Guess& line(const std::string& name, double first, double last);
  /// f(t) for a state or control; t runs between the t0 and tf of the finished guess.
  Guess& function(const std::string& name, std::function<double(double t)> value);
  /// All variables that the earlier problem has too, by its polynomials, and t0 and tf. Its points
  /// become points of the guess. Any mesh and scheme will do.
  Guess& from(const Problem& earlier, const Solution& solution, const Carry& carry = {});
  /// The same from a trajectory, linear between its points.
  Guess& from(const Problem& earlier, const Trajectory& trajectory, const Carry& carry = {});
  /// States and controls by simulation from x0, over t0 ... tf as set so far. Throws InvalidValue
  /// when the simulation does not reach tf.
  Guess& simulated(const std::vector<double>& x0, const Controls& controls,
                   double tolerance = 1e-9);

  Trajectory trajectory() const;
  operator Trajectory() const { return trajectory(); }  // NOLINT(google-explicit-constructor)

 private:
  /// A variable's value by tau and time.
  using Value = std::function<double(double tau, double t)>;
  using Row = std::function<std::vector<double>(double tau, double t)>;

  Value& over_time(const std::string& name);
  void take(const Problem& earlier, const Trajectory& ends, const Row& states, const Row& controls,
            const Carry& carry);

  Problem problem_;
  Trajectory once_;          ///< t0, tf and what has one value
  std::vector<double> tau_;  ///< of the points, in any order
  std::vector<Value> states_, controls_;
};

}  // namespace slalom::ocp
