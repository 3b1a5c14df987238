#pragma once

#include <string>
#include <vector>

#include "../io/document.hpp"

namespace slalom::paper {

/// The map in a file of the built-in config/paper. Throws InvalidValue for a file that holds none
/// and for members other than `known`.
io::Value read_map(const std::string& file, const std::vector<std::string>& known);

}  // namespace slalom::paper
