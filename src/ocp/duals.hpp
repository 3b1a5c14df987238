#pragma once

#include <span>
#include <string>
#include <vector>

#include "builder.hpp"
#include "slalom/ocp/transcription.hpp"

namespace slalom::ocp {

/// What Transcription::costates says; the batches must have been evaluated, with derivatives `at`
/// the point.
std::vector<std::vector<double>> costates(const Transcribed& data, std::span<const double> y,
                                          const nlp::Evaluation& at);
/// Of a constraint's rows: "name", or "family[member]".
std::string name_of(const Problem& problem, RowOrigin origin);
std::vector<Multipliers> multipliers(const Problem& problem, const Transcribed& data,
                                     const nlp::Start& point);
std::vector<Excesses> excesses(const Problem& problem, const Transcribed& data,
                               std::span<const double> x);

}  // namespace slalom::ocp
