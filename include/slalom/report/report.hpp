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

/// The drive's pictures, fit for print at 8 cm width: path, speed, acceleration, steering, lateral
/// motion, wheel loads, solve time.
std::vector<Figure> drive_figures(const sim::Scenario& scenario, const sim::Drive& drive);

}  // namespace slalom::report
