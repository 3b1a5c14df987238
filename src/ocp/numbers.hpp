#pragma once

#include <string>
#include <vector>

#include "builder.hpp"
#include "slalom/ocp/problem.hpp"

namespace slalom::ocp {

/// A number of a problem's statement that may change while its structure stays.
struct Number {
  enum class Kind {
    parameter,
    member,  ///< of a family: one of a member's numbers, at all points alike
    weight,  ///< of a soft constraint
    // Bounds.
    state,
    initial,
    final,
    control,
    slack,
    static_parameter,
    integral,
    t0,
    tf,
    constraint,
  };
  enum class Side { both, lower, upper };  ///< of bounds; both of an equation

  std::string name;
  double value = 0;
  Kind kind = Kind::parameter;
  std::size_t index = 0;  ///< of the parameter, the variable or the constraint
  Side side = Side::both;
  std::size_t member = 0, symbol = 0;
};

/// All of a problem, named as include/slalom/ocp/sensitivity.hpp says. What is switched off has
/// none.
std::vector<Number> numbers(const Problem& problem);

/// Throws InvalidValue for bounds that stand where they are declared: over the horizon, and of
/// constraints.
void set_number(const Number& number, double value, Problem& problem);
/// Place of the number of that name in a list. Throws InvalidValue, naming the nearest.
std::size_t number_named(const std::string& where, const std::string& name,
                         const std::vector<std::string>& known);

/// How fast the numbers move that a transcription was filled with.
struct Direction {
  std::vector<std::vector<double>> data;  ///< of each batch, as Batch::data
  nlp::Limits limits;
};

/// With a rate of 1 of that number. Throws InvalidValue for an end of the horizon where a row, a
/// cost term or a breakpoint stands at a time, since the mesh would move.
Direction direction_of(const Problem& problem, const Transcribed& transcribed,
                       const Number& number);
/// From the numbers of one transcription to those of another of the same structure.
Direction direction_between(const Transcribed& from, const Transcribed& to);

}  // namespace slalom::ocp
