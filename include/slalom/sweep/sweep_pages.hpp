#pragma once

#include <filesystem>

#include "slalom/report/sweep_report.hpp"

namespace slalom::sweep {

/// Writes index.html and figures/ of the sweep that stands in `folder`, with `published` beside it
/// where the two are comparable. Throws Error when there is no sweep, or when they cannot be
/// written.
void write_sweep_report(const std::filesystem::path& folder,
                        const report::PublishedSweep& published);

}  // namespace slalom::sweep
