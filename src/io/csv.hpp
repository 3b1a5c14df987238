#pragma once

#include <optional>
#include <string>
#include <vector>

namespace slalom::io {

/// A text cell of a CSV file: quoted when it holds what would break a row.
std::string csv_cell(const std::string& text);

/// The cells of a row; a quoted one may hold commas and doubled quotes.
std::vector<std::string> csv_cells(const std::string& line);

/// A finite number that is the whole text.
std::optional<double> csv_number(const std::string& text);

}  // namespace slalom::io
