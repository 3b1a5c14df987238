#pragma once

#include <string>
#include <vector>

#include "../io/document.hpp"
#include "evaluate.hpp"

namespace slalom::paper {

/// A table or figure of the paper and what makes ours; config/paper/index.yaml.
struct IndexRow {
  std::string of, command, where, ours, printed;
};
/// Ours is a dash where it was not driven.
std::vector<IndexRow> paper_index(const Evidence& evidence);

/// How many values of one of the paper's tables of parameters are ours as printed, and which are
/// not; config/paper/tables.yaml.
std::string compare_parameters(const std::string& table);

/// The values that "5", "[1, 2]", "[6, 36 x 0.4]" and "[1, 0:5:175]" stand for, each as text.
std::vector<std::string> expanded(const io::Value& value);
/// Whether `ours`, rounded to as many decimals as are printed, is what is printed.
bool agrees(const std::string& printed, double ours);

}  // namespace slalom::paper
