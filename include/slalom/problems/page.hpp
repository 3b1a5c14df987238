#pragma once

#include <string>
#include <vector>

#include "slalom/problems/library.hpp"

namespace slalom::problems {

/// The entry's tags, as files name them, separated by commas.
std::string tags_of(const Entry& entry);

/// docs/problems.md: the entries as Markdown.
std::string page(const std::vector<Entry>& entries);

}  // namespace slalom::problems
