#pragma once

#include <vector>

#include "slalom/io/scenario_file.hpp"
#include "slalom/study/reproduction.hpp"

namespace slalom::io {

/// Reads what the paper printed from the built-in config/paper. Throws InvalidValue with
/// file:line:column when a file there is not as it should be.
study::PaperData load_paper_data();

/// The cases of the paper's conceptual figure with their scenarios, not driven yet. The request's
/// tex and overrides hold for all, after a case's own.
std::vector<study::ConceptCase> load_concept_cases(const ScenarioRequest& request);

}  // namespace slalom::io
