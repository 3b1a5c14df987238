#pragma once

#include <nanobind/stl/variant.h>

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "binding.hpp"
#include "slalom/base/options.hpp"
#include "slalom/nlp/solver.hpp"
#include "slalom/ocp/phases.hpp"
#include "slalom/ocp/trajectory.hpp"
#include "solved.hpp"

namespace slalom::python {

using MeshChoice = std::variant<int, std::vector<double>>;
using SchemeChoice = std::variant<std::string, std::vector<std::string>>;
/// None: 4 where the scheme has a choice.
using PointsChoice = std::optional<std::variant<int, std::vector<int>>>;

/// How Python says a grid: a number of intervals or breakpoints; a scheme and its points, each one
/// for all intervals or one for each interval.
struct GridChoice {
  MeshChoice mesh = 40;
  SchemeChoice scheme = "hermite_simpson";
  PointsChoice points = std::nullopt;
};

/// Sizes that a caller gives are bounded, for what they make cannot be interrupted. Throws
/// InvalidValue.
void check_at_most(std::int64_t value, std::int64_t most, const std::string& where);
/// Of one call.
inline constexpr std::int64_t kMostThreads = 1024;

/// Throws InvalidValue for lists that have not one entry an interval; warns of points for schemes
/// that all have a number of their own.
ocp::PhasedTranscription::Grid grid_of(const GridChoice& choice, const std::string& where);

/// An option's value as Python or NumPy gave it; a TypeError that names it for another type.
OptionValue option_value(nb::handle value, const std::string& name);

/// Solver options from keyword arguments, by their table. Throws InvalidValue for another name;
/// `others` are keywords that a misspelt one may have meant, besides those of every solve.
nlp::Options options_of(const nb::kwargs& given, const std::vector<std::string>& others);

/// None; an earlier Solution or a Simulation, by name; or a dictionary over straight lines between
/// the bounds of both ends: "t0" and "tf", or "t", times from t0 to tf; and by name each state's
/// and control's number, numbers (one for each time of "t", else at equal steps) or function of
/// times, and each static parameter's and slack's number.
ocp::Trajectory guess_of(const ocp::Problem& problem, nb::handle given);

/// What Problem.solve's keywords come to. The settings may point to `warm_start`.
ocp::SolveSettings settings_of(const ocp::Problem& problem, const GridChoice& choice,
                               const std::string& backend, nb::handle guess,
                               const Solved* warm_start, const nb::kwargs& options,
                               const std::vector<std::string>& keywords = {});

/// Throws InvalidValue unless the earlier problem has this one's states and controls: then an
/// answer to it may be carried over whole.
void check_alike(const ocp::Problem& problem, const ocp::Problem& earlier);

}  // namespace slalom::python
