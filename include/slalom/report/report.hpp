#pragma once

#include <string>
#include <vector>

#include "slalom/sim/drive.hpp"
#include "slalom/sim/scenario.hpp"

namespace slalom::report {

/// A named picture as SVG text.
struct Figure {
  std::string file;  ///< e.g. "path.svg"
  std::string caption;
  std::string svg;
};

/// One self-contained HTML page on which the drive plays; works offline.
std::string drive_page(const sim::Scenario& scenario, const sim::Drive& drive);

/// A page and what messages call it: its file.
struct NamedPage {
  std::string name, html;
};

/// One page on which two drives play side by side: on one stage and one axis of time, with a table
/// of what they differ in. `first` and `second` are pages from drive_page(), of any two scenarios.
/// Throws InvalidValue naming the page when it has no drive, nothing was driven, or another version
/// of the program wrote it in another format.
std::string comparison_page(const NamedPage& first, const NamedPage& second);

/// The drive's pictures, fit for print at 8 cm width: path, speed, acceleration, steering, lateral
/// motion, wheel loads, solve time.
std::vector<Figure> drive_figures(const sim::Scenario& scenario, const sim::Drive& drive);

}  // namespace slalom::report
