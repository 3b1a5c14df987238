#pragma once

#include <string>
#include <vector>

#include "slalom/report/report.hpp"
#include "slalom/report/svg.hpp"

namespace slalom::report {

/// A table's cell; `html` as it is, `kind` its class.
std::string cell(const std::string& html, const char* kind = "num");

/// A row of column heads, HTML each; all but the first are of numbers.
std::string head_cells(const std::vector<std::string>& names);
/// The beginning of a row: its head, which is text.
std::string row_head(const std::string& text);

/// A table that scrolls by itself; `head` and `rows` are HTML.
std::string table(const std::string& head, const std::string& rows);

/// A figure as part of a page, with a link to its file in figures/.
std::string figure_html(const Figure& figure);

/// One look for each planner in every figure.
Stroke planner_stroke(const std::string& planner);

}  // namespace slalom::report
