#pragma once

#include <vector>

#include "reproduction.hpp"
#include "slalom/io/scenario_file.hpp"

namespace slalom::paper {

/// Reads what the paper printed from the built-in config/paper. Throws InvalidValue with
/// file:line:column when a file there is not as it should be.
PaperData load_paper_data();

/// The drives of the paper's figures, then those that its text alone mentions, with their
/// scenarios, not driven yet. The request's tex and overrides hold for all.
std::vector<ReproducedDrive> load_drives(const PaperData& paper,
                                         const io::ScenarioRequest& request);

/// The drives that only claims look at, likewise.
std::vector<ReproducedDrive> load_besides(const io::ScenarioRequest& request);

/// The cases of the paper's conceptual figure with their scenarios, not driven yet. The request's
/// tex and overrides hold for all, after a case's own.
std::vector<ConceptCase> load_concept_cases(const io::ScenarioRequest& request);

}  // namespace slalom::paper
