#pragma once

#include <string>
#include <vector>

#include "document.hpp"

namespace slalom::io {

/// A column of a table: the names by which a CSV file's first line may have it. A table may lack
/// its last columns if they may be absent.
struct Column {
  std::vector<std::string> names;
  bool may_be_absent = false;
};

/// Rows of finite numbers: a list of lists, or the name of a CSV file whose first line, after a '#'
/// or without, names its columns. A path counts from the folder of the file the value stands in.
/// `what` names a row in messages, e.g. "a row of a table". All rows have the same columns. Throws
/// InvalidValue with file, line and what was expected.
std::vector<std::vector<double>> read_rows(const Value& value, const std::vector<Column>& columns,
                                           const std::string& what);

}  // namespace slalom::io
