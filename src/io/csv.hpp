#pragma once

#include <optional>
#include <sstream>
#include <string>
#include <vector>

namespace slalom::io {

/// A text cell of a CSV file: quoted when it holds what would break a row.
std::string csv_cell(const std::string& text);

/// The cells of a row; a quoted one may hold commas and doubled quotes.
std::vector<std::string> csv_cells(const std::string& line);

/// A finite number that is the whole text.
std::optional<double> csv_number(const std::string& text);

/// The rows of a CSV file that are not blank. A byte-order mark before the first and a '#' at its
/// beginning are no part of it, nor are blanks about a cell of that cell.
class CsvRows {
 public:
  explicit CsvRows(const std::string& text) : lines_(text) {}
  /// The cells of the next row, or nothing at the end.
  std::optional<std::vector<std::string>> next();
  /// The number of its line, from 1 on.
  int line() const { return line_; }

 private:
  std::istringstream lines_;
  int line_ = 0;
  bool first_ = true;
};

}  // namespace slalom::io
