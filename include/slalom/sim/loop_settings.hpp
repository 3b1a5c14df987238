#pragma once

#include <vector>

#include "slalom/base/options.hpp"

namespace slalom::sim {

/// What the vehicle does in a cycle whose NLP is not solved.
enum class OnFailure { stop, last_plan, best_iterate };

/// What planning may take of this thread's time: no limit of its own, or the execution horizon.
enum class Deadline { by_planner, off, tex };

/// When a plan takes effect, and from which state it starts.
enum class LatencyRule {
  instant,   ///< at once: the plant waits, nothing is predicted
  paper,     ///< at t0 + tex, however long planning took
  measured,  ///< at t0 + tex, or when it is ready if that is later, by the wall clock
  recorded,  ///< the same by recorded solve times
  model      ///< the same by drawn solve times
};

/// Settings of the closed loop; section 4 of docs/formulation.md.
struct LoopSettings {
  double tex = 0.5;               ///< execution horizon [s]
  double timeout = 60;            ///< longest drive [s]
  double solve_time_limit = 300;  ///< of one solve, wall clock [s]
  Deadline deadline = Deadline::by_planner;
  LatencyRule latency = LatencyRule::paper;
  std::vector<double>
      solve_times;  ///< `recorded`: one for each cycle, again from the first after the last
  double latency_median = 0.1;  ///< `model`: of the lognormal distribution [s]
  double latency_spread = 0.5;  ///< standard deviation of its logarithm
  int latency_seed = 0;
  OnFailure on_failure = OnFailure::stop;
  double best_iterate_tol = 1e-3;  ///< largest violation of a best iterate to be driven [its unit]
  bool compensate_delay = false;   ///< the planner knows of the delays of sensing and actuator
  bool warm_up = true;             ///< solve the first OCP once before the clock starts
  double sm_crash = 2;             ///< margin by which obstacles grow in the crash check [m]
  double Fz_failure = 100;         ///< least wheel load in the plant [N]
  double plant_tolerance = 1e-9;   ///< relative and absolute, of the adaptive integrator
  double sample_step = 0.02;       ///< longest step between recorded plant samples [s]
};

const OptionTable<LoopSettings>& loop_options();

}  // namespace slalom::sim
