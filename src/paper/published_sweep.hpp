#pragma once

#include "slalom/report/sweep_report.hpp"

namespace slalom::paper {

/// What the paper printed of its sweep, from the built-in config/paper/sweep.yaml.
report::PublishedSweep published_sweep();

}  // namespace slalom::paper
