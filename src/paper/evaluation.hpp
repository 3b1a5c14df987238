#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "claims.hpp"
#include "reproduction.hpp"
#include "slalom/report/sweep_report.hpp"

namespace slalom::paper {

/// A sweep of the paper's kind, driven before.
struct ReproducedSweep {
  std::string folder;
  report::SweepTable table;
};

/// All that is set beside the paper.
struct Reproduction {
  PaperData paper;
  std::vector<ReproducedDrive> drives;
  std::vector<ConceptCase> cases;
  std::vector<ReproducedDrive> besides;  ///< that only claims look at
  std::vector<ReproducedSweep> sweeps;
  int repeats = 1;  ///< drives of each, for its solve times
};

/// The claims about drives, judged; those about sweeps too look at the first.
std::vector<Judged> judge_drives(const Reproduction& reproduction);

/// Every table as JSON: drives, control effort, cases, claims, the index of the paper's tables and
/// figures, and each sweep (docs/output-files.md).
std::string evaluation_json(const Reproduction& reproduction);

/// Writes index.html, evaluation.json and the figures; the drives stand in folders of their own.
void write_reproduction(const std::filesystem::path& folder, const Reproduction& reproduction);

}  // namespace slalom::paper
