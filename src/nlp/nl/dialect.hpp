#pragma once

#include <string>
#include <vector>

#include "slalom/nlp/solver.hpp"

namespace slalom::nlp {

/// The words for the command line of the solver `executable` (a file name) that ask for `options`,
/// nl_options last. Throws InvalidValue for a floor that it could not honour: Ipopt alone stops at
/// one.
std::vector<std::string> command_words(const std::string& executable, const Options& options);

}  // namespace slalom::nlp
