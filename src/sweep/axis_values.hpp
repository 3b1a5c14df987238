#pragma once

#include <optional>
#include <string>
#include <vector>

#include "../io/document.hpp"

namespace slalom::sweep {

// What the readers of axes and draws share. All throw InvalidValue with the value's place.

/// The finite number a plain scalar states, or nothing. Does not throw.
std::optional<double> number_of(const io::Value& value);

/// The finite number a value states.
double finite(const io::Value& value);

/// A value that states a number, in its shortest form.
io::Value scalar(double number, const io::Place& place);

/// Throws unless `map` is a map with keys among `known`; `path` names it.
void only(const io::Value& map, const std::string& path, const std::vector<std::string>& known);

/// The items of a list that must have some; `content` says what it is a list of.
const std::vector<io::Value>& some_items(const io::Value& value, const std::string& content);

}  // namespace slalom::sweep
