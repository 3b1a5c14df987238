#pragma once

#include <string>

#include "slalom/problems/library.hpp"

namespace slalom::problems {

/// The entry's tags, as files name them, separated by commas.
std::string tags_of(const Entry& entry);

/// docs/problems.md: the whole library as Markdown.
std::string page();

}  // namespace slalom::problems
