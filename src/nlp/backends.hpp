#pragma once

#include <memory>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "slalom/nlp/solver.hpp"

namespace slalom::nlp {

/// Whether Ipopt's library can be loaded on this machine.
bool has_ipopt();
/// Ipopt (Waechter & Biegler, Math. Program. 106, 2006). Throws InvalidValue without its library.
std::unique_ptr<Solver> make_ipopt();

/// KNITRO (Byrd, Nocedal & Waltz 2006); only in builds with SLALOM_WITH_KNITRO.
std::unique_ptr<Solver> make_knitro();

/// Any solver that reads AMPL's .nl files, as a process of its own.
std::unique_ptr<Solver> make_nl();

/// The interior-point method on the stage-structured factorisation.
std::unique_ptr<Solver> make_interior_point();

/// A solver's own options, in its words.
using NativeOptions = std::vector<std::pair<std::string, std::variant<int, double, const char*>>>;
/// What makes Ipopt honour `options`, but for the time limit.
NativeOptions ipopt_options(const Options& options);
/// Likewise for KNITRO.
NativeOptions knitro_options(const Options& options);

/// Finds the row of `answer` that is violated most, from the problem's functions.
void note_violation(Problem& problem, Answer& answer);

}  // namespace slalom::nlp
