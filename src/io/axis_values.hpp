#pragma once

#include <optional>
#include <string>
#include <vector>

#include "document.hpp"

namespace slalom::io {

// What the readers of axes and draws share. All throw InvalidValue with the value's place.

/// The finite number a plain scalar states, or nothing. Does not throw.
std::optional<double> number_of(const Value& value);

/// The finite number a value states.
double finite(const Value& value);

/// A value that states a number, in its shortest form.
Value scalar(double number, const Place& place);

/// Throws unless `map` is a map with keys among `known`; `path` names it.
void only(const Value& map, const std::string& path, const std::vector<std::string>& known);

/// The items of a list that must have some; `content` says what it is a list of.
const std::vector<Value>& some_items(const Value& value, const std::string& content);

}  // namespace slalom::io
