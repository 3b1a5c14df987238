#pragma once

#include "document.hpp"
#include "slalom/base/options.hpp"

namespace slalom::io {

/// The numbers of the file that a scalar names: a CSV file with the option's column (solve_time_s
/// for solve_times), or plain numbers, one on each line. A path counts from the folder of the file
/// the value stands in. Throws InvalidValue with file and line.
std::vector<double> read_numbers(const OptionInfo& info, const Value& name);

}  // namespace slalom::io
