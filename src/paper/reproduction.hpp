#pragma once

#include <limits>
#include <string>
#include <vector>

#include "judged.hpp"
#include "slalom/report/report.hpp"
#include "slalom/sim/drive.hpp"
#include "slalom/sim/scenario.hpp"

namespace slalom::paper {

/// One of the drives of the paper's figures, with ours.
struct ReproducedDrive {
  sim::Scenario scenario;
  sim::Drive drive;
  std::string folder;  ///< relative to the page, e.g. "E_C/P_D"
  /// CPU time of each cycle [s], the median over several drives; empty: of this one alone.
  std::vector<double> cpu = {};
};

/// What the paper printed for one drive; config/paper/drives.yaml, keys as the members are named. A
/// key that is left out keeps the default here.
struct PaperDrive {
  std::string environment, planner;
  std::string outcome;  ///< as sim::to_string(Outcome) has it
  std::string hit;      ///< obstacle crashed into
  double time = 0;      ///< end of the last execution horizon [s]
  double earliest = 0;  ///< ours ends as the paper's from here [s]
  double latest = std::numeric_limits<double>::infinity();   ///< to here [s]
  double end_ux = std::numeric_limits<double>::quiet_NaN();  ///< speed at the end, if told [m/s]
  double lag = 0;  ///< by how much the paper's series lags [s]; its snapshots are not comparable
  struct Snapshot {
    double t = 0;            ///< the instant meant [s]
    double t_printed = 0;    ///< as the figure has it, rounded [s]
    double x = 0, y = 0;     ///< front axle's centre [m]
    double psi = 0;          ///< [rad]
    bool comparable = true;  ///< false where the series lags
    double tolerance = 2.5;  ///< [m]
  };
  std::vector<Snapshot> snapshots;
  std::string note;  ///< where and why ours differs
};

/// One case of the paper's conceptual figure, as a drive; config/paper/cases.yaml.
struct ConceptCase {
  std::string name;            ///< A to F
  std::string specifications;  ///< of the paper's table, that its planner has
  std::string says;            ///< what the paper's text says comes of it
  std::string outcome;         ///< the same as sim::to_string(Outcome) has it
  std::string faster_than;     ///< a case that this one is to beat; empty: none
  ReproducedDrive driven;
};

/// The paper's published figures; read from config/paper: `drives` from drives.yaml, the rest
/// from results.yaml.
struct PaperData {
  std::vector<PaperDrive> drives;
  /// A drive of which its text alone speaks.
  struct Mentioned {
    std::string environment, planner;
  };
  std::vector<Mentioned> mentioned;
  struct Effort {
    double steering_angle = 0, steering_rate = 0, jerk = 0, total = 0;
  };
  Effort effort_P_B, effort_P_C;
  /// What a reader must know about one table of the page. Topics: outcomes, floor, effort,
  /// positions, solve_times, speeds, or an environment's name.
  struct Note {
    std::string topic, text;
  };
  std::vector<Note> notes;
};

/// Control effort of a drive by the paper's table (0.1 * integral of the square, all three) or by
/// the cost's own weights w_sa, w_sr, w_jx.
struct ControlEffort {
  double steering_angle = 0, steering_rate = 0, jerk = 0;
  double total() const { return steering_angle + steering_rate + jerk; }
};
ControlEffort effort_paper(const sim::Drive& drive);
ControlEffort effort_weighted(const sim::Drive& drive, const planner::Settings& settings);

/// One page with all tables and figures, ours | paper's, and its figures as print-ready SVG.
std::string reproduction_page(const std::vector<ReproducedDrive>& drives, const PaperData& paper,
                              const std::vector<ConceptCase>& cases = {},
                              const std::vector<Judged>& claims = {});
std::vector<report::Figure> reproduction_figures(const std::vector<ReproducedDrive>& drives,
                                                 const PaperData& paper,
                                                 const std::vector<ConceptCase>& cases = {});

}  // namespace slalom::paper
