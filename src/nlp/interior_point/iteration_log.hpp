#pragma once

#include "descent.hpp"
#include "slalom/nlp/solver.hpp"

namespace slalom::nlp::ipm {

IterationInfo iteration_info(const Descent& descent, int iteration, bool restoration);
/// A line of the log on standard output, with a heading every twenty.
void print(const IterationInfo& info);
/// Why a solve ended, in words.
const char* reason(Status status);

}  // namespace slalom::nlp::ipm
