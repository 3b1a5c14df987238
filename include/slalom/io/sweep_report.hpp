#pragma once

#include <filesystem>

#include "slalom/study/sweep_report.hpp"

namespace slalom::io {

/// Reads what the paper printed of its sweep from the built-in config/paper/sweep.yaml.
study::PaperSweep load_paper_sweep();

/// Writes index.html and figures/ of the sweep that stands in `folder`. Throws Error when there is
/// none, or when they cannot be written.
void write_sweep_report(const std::filesystem::path& folder);

}  // namespace slalom::io
