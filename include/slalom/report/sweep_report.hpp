#pragma once

#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include "slalom/report/report.hpp"
#include "slalom/report/statistics.hpp"
#include "slalom/report/sweep_table.hpp"

namespace slalom::report {

/// What the paper printed of its sweep; config/paper/sweep.yaml, keys as the members are named.
struct PublishedSweep {
  struct Count {
    std::string planner;
    int passed = 0, trials = 0;
  };
  /// Real-time factor and probability of safety at one execution horizon, over the speeds of O2 up
  /// to `speed`. NaN where nothing is printed.
  struct Point {
    std::string planner;
    double tex = 0;    ///< [s]
    double speed = 0;  ///< [m/s]
    double rtf = TrialRecord::kNone, pos = TrialRecord::kNone;
  };
  struct Note {
    std::string topic, text;  ///< topics: counts, real_time, table
  };
  std::vector<Count> counts;
  std::vector<Point> points;
  std::vector<Note> notes;

  /// Whether a sweep is of the paper's kind, so that its figures may stand beside: E_C over
  /// loop.tex and obstacles.O2.vy.
  static bool comparable(const SweepTable& table);
};

/// Passes of one planner.
struct PassCount {
  std::string planner;
  std::int64_t passed = 0, trials = 0;
};
/// One a planner that has trials, in the study's order.
std::vector<PassCount> pass_counts(const SweepTable& table);

/// Passes in one scenario, of every planner of the study; one without trials there has zeros.
struct ScenarioCount {
  std::string scenario;
  std::vector<PassCount> planners;
};
/// One a scenario that has trials, in the study's order.
std::vector<ScenarioCount> scenario_counts(const SweepTable& table);

/// Trials of two planners that differ in nothing else.
struct PairCount {
  std::int64_t both = 0, only1 = 0, only2 = 0, neither = 0;
};
PairCount pair_count(const SweepTable& table, const std::string& planner1,
                     const std::string& planner2);

/// One execution horizon of one planner, by the paper's definitions.
struct HorizonRow {
  double tex = 0;  ///< [s]
  std::int64_t passed = 0, trials = 0;
  double rtf = 0, rtf_cpu = 0;  ///< mean over trials of the longest solve, over tex; wall, CPU
  double rtf_cpu_95 = 0;        ///< 95th percentile over trials of the same, by CPU
  double pos() const;           ///< probability of safety: passed / trials
};
/// In order of tex; empty when tex is no axis. Trials at higher |speed of O2| than `speed` are left
/// out. Trials that failed or are invalid count as not passed and have no solve times.
std::vector<HorizonRow> horizon_rows(const SweepTable& table, const std::string& planner,
                                     double speed = std::numeric_limits<double>::infinity());

/// How short execution horizons must be at one value of the axis beside tex.
struct LongestHorizon {
  struct Planner {
    std::string planner;
    /// The longest at which, and at all shorter ones, the share of passes is the best there is [s];
    /// NaN where none passes or the shortest is not as good.
    double tex = TrialRecord::kNone;
    std::int64_t best = 0;  ///< horizons with the best share
  };
  std::string key;  ///< of the other axis
  double value = 0;
  std::int64_t horizons = 0;
  std::vector<Planner> planners = {};  ///< in the study's order
};
/// In order of the value; empty unless tex and another numeric axis vary.
std::vector<LongestHorizon> longest_horizons(const SweepTable& table);

/// The page of a sweep, self-contained; a click on a trial's mark opens its drive. `kept`: trials
/// whose drives stand beside it. The pictures are those of the page.
std::string sweep_page(const SweepTable& table, const PublishedSweep& paper,
                       const std::set<std::int64_t>& kept = {});
std::vector<Figure> sweep_figures(const SweepTable& table);

}  // namespace slalom::report
