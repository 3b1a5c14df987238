#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "slalom/report/sweep_table.hpp"

namespace slalom::report {

inline constexpr const char* kTexKey = "loop.tex";
inline constexpr const char* kSpeedKey = "obstacles.O2.vy";

/// Where a key stands among the table's columns.
std::optional<std::size_t> column_index(const SweepTable& table, const std::string& key);

/// The two columns to look over: tex first, if it varies, then in the study's order; numeric ones
/// that take several values.
std::vector<std::size_t> drawn_columns(const SweepTable& table);

/// The number in a column; NaN for text.
double number_at(const TrialRecord& record, std::size_t column);

}  // namespace slalom::report
