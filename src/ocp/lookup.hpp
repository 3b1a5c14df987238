#pragma once

#include <string>
#include <vector>

namespace slalom::ocp {

/// Place of `name` among what an answer knows. Throws InvalidValue, with the nearest name, for one
/// that is not there; `what` it would be, such as "state".
std::size_t index_of(const std::string& name, const std::vector<std::string>& known,
                     const char* what);

/// One column of a table.
std::vector<double> column(const std::vector<std::vector<double>>& rows, std::size_t i);

}  // namespace slalom::ocp
