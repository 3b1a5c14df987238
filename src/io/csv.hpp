#pragma once

#include <string>

namespace slalom::io {

/// A text cell of a CSV file: quoted when it holds what would break a row.
std::string csv_cell(const std::string& text);

}  // namespace slalom::io
