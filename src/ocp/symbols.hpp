#pragma once

#include <string>
#include <unordered_map>

#include "layout.hpp"
#include "slalom/ocp/problem.hpp"

namespace slalom::ocp {

/// What a symbol of the problem stands for.
struct Meaning {
  enum class Kind {
    state,
    control,
    initial,
    final,
    slack,
    t0,
    tf,
    static_parameter,
    integral,
    tau,
    time,
    parameter,
  } kind;
  std::size_t index = 0;
};

/// The symbols of one problem, and what its functions use of them.
class Symbols {
 public:
  explicit Symbols(const Problem& problem);

  /// Null for a symbol the problem did not make.
  const Meaning* find(const Expr& symbol) const;
  /// The end at which a boundary function is evaluated: the final one if it uses anything there.
  /// Throws InvalidValue for what is no end value.
  End end_of(const Expr& value, const std::string& name) const;
  /// The end values that a function at another point uses.
  Lifts find_lifts() const;

 private:
  /// Calls see(meaning, symbol) for each known symbol of `value`.
  template <class F>
  void for_symbols(const Expr& value, F see) const;

  const Problem& problem_;
  std::unordered_map<const expr::Node*, Meaning> meaning_;
};

/// Whether a constraint is of another kind, switched off, or bounds nothing.
bool absent(const Problem::Constraint& row, Problem::Kind kind);
/// Whether an end of the horizon is a given number.
bool is_fixed(const Problem::Variable& time);

}  // namespace slalom::ocp
