#pragma once

#include <string>
#include <vector>

#include "reproduction.hpp"

namespace slalom::paper {

/// Whether a case came out as the paper's text says: its outcome, and before the case it is to beat
/// (which must have arrived).
bool holds(const ConceptCase& one, const std::vector<ConceptCase>& cases);

/// How a case's drive ended, in few words.
std::string ended(const ConceptCase& one);

/// Its planner, and its model where that is not the vehicle's own.
std::string planner_words(const ConceptCase& one);

/// The cases as the paper's conceptual figure has them: one strip each, from left to right.
report::Figure concept_figure(const std::vector<ConceptCase>& cases);

/// The cases as an HTML table.
std::string concept_table(const std::vector<ConceptCase>& cases);

}  // namespace slalom::paper
