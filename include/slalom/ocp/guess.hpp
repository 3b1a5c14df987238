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

/// Throws InvalidValue unless `guess` is one of `problem`: as many states and controls at each
/// point as it has, no more of what has one value, finite numbers, taus that do not fall, tf not
/// before t0.
void check_guess(const Trajectory& guess, const Problem& problem);

/// How an earlier answer becomes a guess.
struct Carry {
  /// Names here, with theirs in the earlier problem where these differ.
  std::map<std::string, std::string> names = {};
  /// At equal times instead of equal taus, beyond its ends the nearer end's values; t0 and tf stay
  /// as they are.
  bool by_time = false;
};

/// Puts a guess together, variable by variable and by name: it begins as straight_guess, and each
/// call replaces what it names. To be used where a Trajectory is wanted:
///
///   solve(problem, {.guess = Guess(problem).line("x", 0, 10).constant("u", 1)})
///
/// A name that the problem has not throws InvalidValue, naming the nearest.
class Guess {
 public:
  /// `points` equal steps apart, at which functions are sampled; throws InvalidValue below 2.
  explicit Guess(const Problem& problem, int points = 101);

  Guess& times(double t0, double tf);
  /// Of a state or control, or of what has one value: a static parameter, slack or integral.
  Guess& constant(const std::string& name, double value);
  /// Of a state or control, over time.
  Guess& line(const std::string& name, double first, double last);
  /// Of a state or control; t is between t0 and tf as they are in the end.
  Guess& function(const std::string& name, std::function<double(double t)> value);
  /// All variables that the earlier problem has too, by its polynomials, and t0 and tf; its points
  /// become points of the guess. The mesh and scheme may be others.
  Guess& from(const Problem& earlier, const Solution& solution, const Carry& carry = {});
  /// The same of a trajectory, linear between its points.
  Guess& from(const Problem& earlier, const Trajectory& trajectory, const Carry& carry = {});
  /// States and controls by simulation from x0 over t0 ... tf, as these are now. Throws
  /// InvalidValue when it does not come to tf.
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
