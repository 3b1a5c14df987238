#pragma once

#include <optional>
#include <string_view>

namespace slalom::io {

/// The number that is the whole text: a sign or none, then a decimal number, or .inf or .nan as
/// YAML has them. What is too large for a double is infinite, what is too small 0. Every file and
/// option has its numbers by this.
std::optional<double> read_number(std::string_view text);

}  // namespace slalom::io
